// Bodies and the surfaces of colliders, at rest and moving.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/file.h"
#include "cpu/implicit/system_solver.h"
#include "cpu/measure/measure.h"
#include "support/contact_scenes.h"
#include "support/overlaps.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

using test::Block;
using test::kFrame;
using test::make_blocks;
using test::make_solver;

ColliderDescription collider(Shape shape, const glm::dvec3& position = {0, 0, 0}) {
    ColliderDescription description;
    description.shape = std::move(shape);
    description.position = position;
    return description;
}

glm::dvec3 mean_velocity(const Model& model, const cpu::CpuSolver<float>& solver) {
    return cpu::measure(model, solver.nodes())[0].momentum / model.objects[0].mass;
}

double mean_height(const Model& model, const cpu::CpuSolver<float>& solver) {
    double sum = 0.0;
    for (std::uint32_t n = 0; n < model.objects[0].nodes.count; ++n)
        sum += static_cast<double>(solver.nodes().positions[n].y);
    return sum / model.objects[0].nodes.count;
}

// A box, whose edges and corners are sharper and farther apart than a body's.
TEST(ColliderSurfaces, StopBodies) {
    for (const double speed : {1.0, 10.0, 100.0}) {
        const auto model = make_blocks({{.place = {0.05, 0.32, 0.1}, .velocity = {0, -speed, 0}}}, {0, 0, 0},
                                       {collider(BoxShape{glm::dvec3(0.5)})});
        cpu::SystemSolver<float> solver = make_solver<float>(model);
        ASSERT_TRUE(test::stays_apart(solver, *model, 30)) << speed;
        EXPECT_GT(mean_velocity(*model, solver).y, 0.0) << speed;
    }
}

// A sheet has two sides.
TEST(ColliderSurfaces, AreStoppedByFromBothSides) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "sheet.obj";
    write_file(file, "v -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2\nf 1 3 2\nf 1 4 3\n");
    for (const double side : {1.0, -1.0}) {
        const auto model =
            make_blocks({{.place = {0, side > 0 ? 0.1 : -0.4, 0}, .velocity = {0, -5 * side, 0}}}, {0, 0, 0},
                        {collider(FileShape{file})});
        cpu::SystemSolver<float> solver = make_solver<float>(model);
        ASSERT_TRUE(test::stays_apart(solver, *model, 30));
        EXPECT_GT(side * mean_height(*model, solver), 0.1);
        EXPECT_GT(side * mean_velocity(*model, solver).y, 0.0);
    }
}

// What a block slides down an inclined box with.
double acceleration_on(double friction) {
    const double angle = std::atan(0.5);
    ColliderDescription slope = collider(BoxShape{{20, 1, 2}}, {0, -0.5, 0});
    slope.friction = friction;
    const auto model = make_blocks({{.place = {-0.15, 0.012, -0.15}, .size = {0.3, 0.2, 0.3}}},
                                   9.81 * glm::dvec3(std::sin(angle), -std::cos(angle), 0), {slope});
    cpu::SystemSolver<float> solver = make_solver<float>(model, 2.0);  // between bodies
    for (int frame = 0; frame < 60; ++frame) solver.advance({kFrame});
    const double before = mean_velocity(*model, solver).x;
    for (int frame = 0; frame < 60; ++frame) solver.advance({kFrame});
    return mean_velocity(*model, solver).x - before;
}

TEST(ColliderSurfaces, HaveTheirOwnFriction) {
    const double angle = std::atan(0.5), pressing = 9.81 * std::cos(angle), pulling = 9.81 * std::sin(angle);
    EXPECT_NEAR(acceleration_on(0.6), 0.0, 1e-3 * pulling);  // it still vibrates a little
    EXPECT_NEAR(acceleration_on(0.3), pulling - 0.3 * pressing, 0.02 * 0.3 * pressing);
    EXPECT_NEAR(acceleration_on(0.0), pulling, 0.01);
}

// Friction brings what lies on a belt to its speed, and no farther.
TEST(ColliderSurfaces, ABeltCarries) {
    ColliderDescription belt = collider(BoxShape{{20, 1, 2}}, {0, -0.5, 0});
    belt.friction = 0.2;
    belt.surface_velocity = {1, 0, 0};
    const auto model =
        make_blocks({{.place = {-0.15, 0.012, -0.15}, .size = {0.3, 0.2, 0.3}}}, {0, -9.81, 0}, {belt});
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    for (int frame = 0; frame < 15; ++frame) solver.advance({kFrame});
    const double before = mean_velocity(*model, solver).x;
    for (int frame = 0; frame < 12; ++frame) solver.advance({kFrame});
    const double gained = 0.2 * 9.81 * 12 * kFrame;
    EXPECT_NEAR(mean_velocity(*model, solver).x - before, gained, 0.04 * gained);
    for (int frame = 0; frame < 60; ++frame) solver.advance({kFrame});
    EXPECT_NEAR(mean_velocity(*model, solver).x, 1.0, 5e-3);
}

// Two plates take hold of a block, lift it by friction, and let go.
TEST(ColliderSurfaces, CarryByFriction) {
    std::vector<ColliderDescription> plates;
    for (const double side : {-1.0, 1.0}) {
        ColliderDescription plate = collider(BoxShape{{0.1, 0.4, 0.4}}, {side * 0.22, 0.15, 0});
        plate.friction = 0.8;
        plate.keyframes = {{0.0},
                           {0.3, {-side * 0.04, 0, 0}},
                           {1.3, {-side * 0.04, 1, 0}},
                           {1.5, {-side * 0.04, 1, 0}},
                           {1.7, {0, 1, 0}}};
        plates.push_back(plate);
    }
    ColliderDescription floor;
    plates.push_back(floor);
    const auto model =
        make_blocks({{.place = {-0.15, 0, -0.15}, .youngs_modulus = 3e5}}, {0, -9.81, 0}, plates);
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    for (int frame = 0; frame < 150; ++frame) {
        test::advance(solver, *model, frame);
        ASSERT_EQ(test::count_overlaps(*model, solver.nodes().positions), 0u) << frame;
        if (frame == 89) {
            EXPECT_NEAR(mean_height(*model, solver), 1.15, 0.05);
        }
    }
    EXPECT_LT(mean_height(*model, solver), 0.2);
}

// A press does not push a block through the bed below it, wherever its keyframes lead.
TEST(ColliderSurfaces, APressStopsWhereABodyLeavesItNoRoom) {
    ColliderDescription press = collider(BoxShape{{0.6, 0.1, 0.6}}, {0, 0.42, 0}),
                        bed = collider(BoxShape{{0.6, 0.1, 0.6}}, {0, -0.06, 0});
    press.keyframes = {{0.0}, {0.2, {0, -0.42, 0}}, {0.5, {0, -0.42, 0}}, {0.8}};
    const auto model =
        make_blocks({{.place = {-0.15, 0, -0.15}, .youngs_modulus = 1e5}}, {0, 0, 0}, {press, bed});
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    ASSERT_TRUE(test::stays_apart(solver, *model, 90));
    EXPECT_GT(cpu::measure(*model, solver.nodes())[0].volume, 0.95 * 0.027);
}

// Of any point of a shape that is within 0.8 m round its centre [m/s].
double greatest_speed(const ColliderDescription& collider) {
    const double speed = glm::length(collider.surface_velocity);
    if (collider.keyframes.size() < 2) return speed;
    const Keyframe& last = collider.keyframes[1];
    const double turn = std::abs(last.turn.x) + std::abs(last.turn.y) + std::abs(last.turn.z);
    return speed + (glm::length(last.move) + 0.8 * glm::radians(turn)) / last.time;
}

// Violent scenes among boxes, balls and capsules that move and turn.
void fuzz_colliders(unsigned first, unsigned count) {
    for (unsigned seed = first; seed < first + count; ++seed) {
        test::RandomMaker random(seed);
        std::vector<Block> blocks;
        for (int k = random.integer(1, 3); k > 0; --k) {
            blocks.push_back({.place = {random.uniform(-0.05, 0.05), 0.4 * k, random.uniform(-0.05, 0.05)},
                              .velocity = random.point(random.magnitude(0.1, 100.0)),
                              .cells = {2, 3, 2},
                              .size = {0.2, 0.25, 0.2},
                              .youngs_modulus = random.magnitude(1e3, 1e9)});
        }
        std::vector<ColliderDescription> colliders;
        const Shape shapes[] = {BoxShape{{0.5, 0.05, 0.5}}, SphereShape{0.2, 4}, CapsuleShape{0.05, 0.6, 4}};
        for (const double height : {0.0, 2.0}) {
            ColliderDescription made = collider(shapes[random.integer(0, 2)], {0.1, height, 0.1});
            made.rotation = random.point(5.0);
            made.friction = random.uniform(0.0, 1.0);
            made.surface_velocity = random.point(1.0);
            if (random.integer(0, 1) == 0)
                made.keyframes = {{0.0},
                                  {random.magnitude(0.01, 1.0), random.point(1.5), random.point(180.0)}};
            colliders.push_back(made);
        }
        const auto model = make_blocks(blocks, {0, -9.81, 0}, colliders);
        cpu::SystemSolver<float> solver =
            make_solver<float>(model, 0.4, random.integer(1, 12), random.integer(0, 1) == 0);
        // At most as if all bodies came at their fastest and went back from the fastest collider.
        double mass = 0.0;
        for (const ModelObject& object : model->objects) mass += object.mass;
        const double start = test::sum_bodies(*model, solver.nodes()).sum();
        double fastest = 0.0;  // of any point of a collider [m/s]
        for (const ColliderDescription& each : colliders) fastest = std::max(fastest, greatest_speed(each));
        const double speed = std::sqrt(2.0 * start / mass);  // with what gravity adds
        const double most = start + 2.0 * mass * fastest * (speed + fastest);
        ASSERT_TRUE(test::stays_apart(solver, *model, 30, kFrame, most)) << "scene " << seed;
    }
}

TEST(ColliderSurfaces, NothingPassesThroughThem) {
    fuzz_colliders(1, 3);
}

TEST(ColliderSurfacesHeavy, NothingPassesThroughThem) {
    fuzz_colliders(4, 9);
    fuzz_colliders(251, 1);  // a ball tears a soft body, which stays tangled
    fuzz_colliders(426, 1);  // what the guard stopped pressed on and gained energy
}

TEST(ColliderSurfacesLong, NothingPassesThroughThem) {
    fuzz_colliders(100, 400);
}

}  // namespace
}  // namespace gelatin
