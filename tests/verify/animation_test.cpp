// Colliders whose vertices move, and bones inside bodies: what they carry and push, and where they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "core/file.h"
#include "gelatin/log.h"
#include "gelatin/simulator.h"
#include "mesh/vertex_motion.h"
#include "model/drive/handle_arms.h"
#include "model/setting_names.h"
#include "support/gl_fixture.h"
#include "support/gltf_maker.h"
#include "support/solver_kinds.h"
#include "verify/support/measured_run.h"

namespace gelatin::animation_test {
namespace {

using namespace test;

constexpr double kGravity = 9.81;  // [m/s^2]
constexpr int kFrameRate = 60;     // [1/s]

// A closed box of 12 faces, its lower corner at the origin.
std::shared_ptr<const Mesh> slab(const glm::dvec3& size) {
    auto mesh = std::make_shared<Mesh>();
    for (int v = 0; v < 8; ++v) mesh->vertices.push_back(size * glm::dvec3(v & 1, v >> 1 & 1, v >> 2));
    mesh->triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

Scene scene_of(double youngs_modulus, double gravity = kGravity) {
    Scene scene;
    scene.simulation.gravity = glm::dvec3(0.0, -gravity, 0.0);
    Material jelly;
    jelly.name = "jelly";
    jelly.youngs_modulus = youngs_modulus;
    jelly.density = 500.0;
    jelly.damping = 0.02;
    scene.materials = {jelly};
    return scene;
}

ObjectDescription object_of(const Shape& shape, const glm::dvec3& position, int nodes = 200) {
    ObjectDescription object;
    object.name = "body";
    object.shape = shape;
    object.material = "jelly";
    object.position = position;
    object.mesher.kind = MesherKind::lattice;
    object.mesher.nodes = nodes;
    return object;
}

// A floor from y = -0.1 to 0 whose vertices go up by `height` [m] at each time, for two seconds.
template <class Height>
ColliderDescription floor_that_rises(const Height& height) {
    ColliderDescription floor;
    floor.name = "floor";
    floor.shape = MeshShape{slab({2.0, 0.1, 2.0})};
    floor.position = {-1.0, -0.1, -1.0};
    auto frames = std::make_shared<std::vector<std::vector<glm::dvec3>>>();
    for (int f = 0; f <= 2 * kFrameRate; ++f) {
        frames->push_back(std::get<MeshShape>(std::get<Shape>(floor.shape)).mesh->vertices);
        for (glm::dvec3& p : frames->back()) p.y += height(static_cast<double>(f) / kFrameRate);
    }
    floor.animation = AnimationDescription{AnimationFrames{frames, kFrameRate}};
    return floor;
}

// Vertices that all go up together act as a collider on keyframes does.
TEST(Animation, VerticesActAsKeyframesDo) {
    constexpr double kAcceleration = 4.0;
    const auto height = [](double t) { return 0.5 * kAcceleration * t * t; };
    Scene scene = scene_of(1e5);
    scene.objects = {object_of(BoxShape{{0.3, 0.2, 0.3}}, {0.0, 0.102, 0.0})};
    scene.colliders = {floor_that_rises(height)};
    MeasuredRun vertices(scene);
    scene.colliders[0].animation.reset();
    for (int f = 0; f <= 2 * kFrameRate; ++f) {
        const double time = static_cast<double>(f) / kFrameRate;
        scene.colliders[0].keyframes.push_back({time, {0.0, height(time), 0.0}});
    }
    MeasuredRun keyframes(scene);
    for (int f = 0; f < 60; ++f) {
        vertices.simulator().advance_frame();
        keyframes.simulator().advance_frame();
        EXPECT_LT(glm::distance(vertices.center(0), keyframes.center(0)), 2e-6);
        EXPECT_EQ(vertices.overlaps(), 0u);
    }
    EXPECT_NEAR(vertices.velocity(0).y, kAcceleration, 0.1);
}

// The same by frames and by a program that sets them one by one.
TEST(Animation, AProgramMovesVerticesAsFramesDo) {
    const auto wave = [](double t) { return 0.1 * (1.0 - std::cos(5.0 * t)); };
    Scene scene = scene_of(5e4);
    scene.objects = {object_of(SphereShape{0.15, 3}, {0.0, 0.16, 0.0})};
    scene.colliders = {floor_that_rises(wave)};
    MeasuredRun frames(scene);
    const auto all = std::get<AnimationFrames>(scene.colliders[0].animation->source).frames;
    scene.colliders[0].animation->source = AnimationByProgram();
    MeasuredRun program(scene);
    for (std::size_t f = 1; f < 60; ++f) {
        frames.simulator().advance_frame();
        program.simulator().set_collider_vertices("floor", (*all)[f]);
        program.simulator().advance_frame();
        EXPECT_LT(glm::distance(frames.center(0), program.center(0)), 1e-6) << f;
        EXPECT_EQ(program.overlaps(), 0u);
    }
    EXPECT_GT(program.center(0).y, 0.2);
}

// The watch on diverging runs does not know how much energy they may give.
TEST(Animation, WhatMovesVerticesMayGiveAnyEnergy) {
    Scene scene = scene_of(1e4, 0.0);
    scene.objects = {object_of(BoxShape{{0.3, 0.1, 0.3}}, {0.0, 0.052, 0.0})};
    scene.colliders = {floor_that_rises([](double t) { return 20.0 * t * t; })};
    MeasuredRun frames(scene);
    frames.advance(2.0);
    EXPECT_NEAR(frames.velocity(0).y, 80.0, 1.0);  // it lies on the floor, which never waits
    EXPECT_GT(frames.statistics().kinetic_energy, 5e3);
    const auto all = std::get<AnimationFrames>(scene.colliders[0].animation->source).frames;
    scene.colliders[0].animation->source = AnimationByProgram();
    MeasuredRun program(scene);
    for (std::size_t f = 1; f < all->size(); ++f) {
        program.simulator().set_collider_vertices("floor", (*all)[f]);
        program.simulator().advance_frame();
    }
    EXPECT_NEAR(program.velocity(0).y, 80.0, 1.0);
    EXPECT_GT(program.statistics().kinetic_energy, 5e3);
}

class AnimatedFiles : public testing::Test {
protected:
    AnimatedFiles() { bending_bar().write(file("bar.glb")); }
    std::filesystem::path file(const char* name) const { return folder_.path() / name; }

    // Of 2 m, from the origin up.
    Scene bar_on_bones(double gravity) const {
        Scene scene = scene_of(3e4, gravity);
        auto mesh = std::make_shared<Mesh>(*slab({0.3, 2.0, 0.3}));
        for (glm::dvec3& p : mesh->vertices) p -= glm::dvec3(0.15, 0.0, 0.15);
        scene.objects = {object_of(MeshShape{mesh}, {0.0, 0.0, 0.0}, 400)};
        HandleDescription handle;
        handle.skeleton = SkeletonDescription{file("bar.glb"), 0.12};
        scene.objects[0].handles = {handle};
        return scene;
    }
    ColliderDescription bar() const {
        ColliderDescription collider;
        collider.name = "bar";
        collider.shape = FileShape{file("bar.glb")};
        collider.animation = AnimationDescription{AnimationClip{"bend"}};
        return collider;
    }

    // A box of flesh around the middle of the bar.
    void glue_to_bar(const glm::dvec3& size, int nodes, Scene& scene) const {
        scene.objects = {object_of(BoxShape{size}, {0.0, 1.0, 0.0}, nodes)};
        scene.colliders = {bar()};
        AttachmentDescription& glue = scene.attachments.emplace_back();
        glue.object = "body";
        glue.to = "bar";
    }

    TemporaryFolder folder_;
};

// Where the bones of the bar have a point.
glm::dvec3 bent(const glm::dvec3& p, double degrees) {
    if (p.y < 1.0) return p;
    const double angle = degrees * std::numbers::pi / 180.0;
    const glm::dvec3 arm = p - glm::dvec3(0.0, 1.0, 0.0);
    return {std::cos(angle) * arm.x - std::sin(angle) * arm.y,
            1.0 + std::sin(angle) * arm.x + std::cos(angle) * arm.y, arm.z};
}

TEST_F(AnimatedFiles, NodesNearBonesAreWhereTheseHaveThem) {
    for (const SolverKind kind : {SolverKind::implicit, SolverKind::semi_implicit_euler, SolverKind::rk4}) {
        Scene scene = bar_on_bones(kGravity);
        scene.simulation.solver = kind;
        scene.objects[0].position = {0.5, 1.0, 0.2};
        scene.objects[0].rotation = {0.0, 180.0, 0.0};
        MeasuredRun run(scene);
        const std::vector<HandleNode>& held = run.model().handle_nodes;
        ASSERT_GT(held.size(), 10u) << name_of(kind);
        ASSERT_LT(held.size(), run.model().node_count() / 2);
        EXPECT_GT(std::count_if(held.begin(), held.end(),
                                [&](const HandleNode& h) { return run.model().positions[h.node].y > 2.5f; }),
                  3);
        for (const double time : {0.5, 1.0, 1.5}) {
            run.advance(0.5);
            const double degrees = std::min(90.0, 90.0 * time);
            for (const HandleNode& node : held) {
                // The skeleton is placed as the body: turned by 180 degrees about y, then moved.
                const glm::dvec3 start(run.model().positions[node.node]),
                    own = glm::dvec3(0.5 - start.x, start.y - 1.0, 0.2 - start.z);
                const glm::dvec3 place = bent(own, degrees),
                                 expected(0.5 - place.x, 1.0 + place.y, 0.2 - place.z);
                EXPECT_LT(glm::distance(expected, glm::dvec3(run.simulator().positions()[node.node])), 2e-6)
                    << name_of(kind) << ' ' << time;
            }
        }
    }
}

// The bar is placed so that its bones are within the body.
TEST_F(AnimatedFiles, FleshHangsOnBonesThatItIsGluedTo) {
    Scene scene = scene_of(1e5);
    glue_to_bar({0.5, 2.2, 0.5}, 1500, scene);
    MeasuredRun run(scene);
    run.advance(4.0);
    const double weight = run.mass(0) * kGravity;
    EXPECT_LT(glm::distance(run.force(0), glm::dvec3(0.0, weight, 0.0)), 0.01 * weight);
    // Nodes within the bar have followed it, but for what their ties yield.
    std::size_t within = 0;
    for (std::uint32_t n = 0; n < run.model().body_node_count(); ++n) {
        const glm::dvec3 start(run.model().positions[n]);
        if (std::abs(start.x) > 0.1 || std::abs(start.z) > 0.1 || start.y < 1.3 || start.y > 2.0) continue;
        ++within;
        EXPECT_LT(glm::distance(bent(start, 90.0), glm::dvec3(run.simulator().positions()[n])), 0.02);
    }
    EXPECT_GT(within, 3u);
    EXPECT_LT(run.fastest(0), 1e-2);
}

// Bones that bend more than flesh around them has room for. If they met, they would push each other apart
// with all that bones can.
TEST_F(AnimatedFiles, FleshThatIsCrushedOnItsBonesGainsNothing) {
    Scene scene = scene_of(2e4, 0.0);
    glue_to_bar({0.8, 1.9, 0.8}, 1000, scene);
    MeasuredRun run(scene);
    double most = 0.0;
    for (int f = 0; f < 2 * kFrameRate; ++f) {
        run.simulator().advance_frame();
        most = std::max(most, run.statistics().kinetic_energy);
    }
    // A rigid half turns at 90 degrees a second.
    const double half = 0.5 * run.mass(0), speed = 0.5 * std::numbers::pi;
    EXPECT_LT(most, 3.0 * 0.5 * half * speed * speed / 3.0);
    EXPECT_LT(run.statistics().kinetic_energy, 0.05 * most);
}

// What a skin presses does not pass through it.
TEST_F(AnimatedFiles, ASkinPressesWhatIsInItsWay) {
    constexpr double kFloor = 0.6, kUnderTheBar = 0.9;
    Scene scene = scene_of(3e4);
    scene.objects = {object_of(SphereShape{0.2, 3}, {-0.6, kFloor + 0.21, 0.0})};
    scene.colliders = {bar(), ColliderDescription{PlaneCollider{{0.0, 1.0, 0.0}, kFloor}}};
    MeasuredRun run(scene);
    for (int f = 0; f < 90; ++f) {
        run.simulator().advance_frame();
        EXPECT_EQ(run.overlaps(), 0u) << f;
    }
    double highest = 0.0, lowest = 1.0;
    for (std::uint32_t n = 0; n < run.model().body_node_count(); ++n) {
        const glm::vec4 p = run.simulator().positions()[n];
        highest = std::max(highest, static_cast<double>(p.y));
        lowest = std::min(lowest, static_cast<double>(p.y));
    }
    EXPECT_NEAR(lowest, kFloor, 0.005);
    EXPECT_NEAR(highest, kUnderTheBar, 0.005);
}

// The surface of a collider may pass through itself: nothing is in its way.
TEST_F(AnimatedFiles, ACollidersOwnSurfaceIsNotInItsWay) {
    auto frames = std::make_shared<std::vector<std::vector<glm::dvec3>>>(2, slab({1.0, 1.0, 1.0})->vertices);
    for (glm::dvec3& p : frames->back()) p.y = 0.3 - 0.5 * p.y;  // inside out
    Scene scene = scene_of(3e4);
    scene.objects = {object_of(SphereShape{0.2, 3}, {3.0, 3.0, 0.0})};
    ColliderDescription box;
    box.name = "box";
    box.shape = MeshShape{slab({1.0, 1.0, 1.0})};
    box.animation = AnimationDescription{AnimationFrames{frames, 1.0}};
    scene.colliders = {box};
    MeasuredRun run(scene);
    run.advance(1.5);
    const Range& nodes = run.model().objects.back().nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::vec4 start = run.model().positions[n], now = run.simulator().positions()[n];
        EXPECT_NEAR(now.y, 0.3f - 0.5f * start.y, 1e-6f);
    }
}

}  // namespace
}  // namespace gelatin::animation_test
