#include "sim/move_apart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "gelatin/error.h"
#include "gelatin/simulator.h"
#include "support/contact_scenes.h"
#include "support/overlaps.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

using test::Block;
using test::make_blocks;
using ::testing::HasSubstr;

std::uint32_t overlaps_of(const Model& model, const std::vector<glm::vec4>& positions) {
    return test::count_overlaps(model, std::vector<cpu::Vec4<float>>(positions.begin(), positions.end()),
                                test::Overlaps::between);
}

// Of an object's nodes, all alike [m].
glm::vec3 motion_of(const Model& model, std::uint32_t object, const MovedApart& moved) {
    const Range& nodes = model.objects[object].nodes;
    const glm::vec3 motion(moved.positions[nodes.first] - model.positions[nodes.first]);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        EXPECT_LT(glm::distance(glm::vec3(moved.positions[n] - model.positions[n]), motion), 1e-6f);
    return motion;
}

TEST(MoveApart, HasNothingToDoWhereAllAreApart) {
    const auto model = make_blocks({{}, {.place = {0.31, 0, 0}}});
    EXPECT_FALSE(move_apart(model, model->positions).has_value());
}

TEST(MoveApart, BodiesShareTheWayByTheirMasses) {
    const auto model = make_blocks({{}, {.place = {0.25, 0.02, 0.01}, .size = glm::dvec3(0.2)}});
    ASSERT_GT(overlaps_of(*model, model->positions), 0u);
    const auto moved = move_apart(model, model->positions);
    ASSERT_TRUE(moved.has_value());
    EXPECT_EQ(overlaps_of(*model, moved->positions), 0u);
    const glm::vec3 large = motion_of(*model, 0, *moved), small = motion_of(*model, 1, *moved);
    EXPECT_NEAR(small.x - large.x, 0.05, 0.02);  // hardly farther than needed
    EXPECT_LT(glm::length(27.0f * large + 8.0f * small), 1e-5f);
    ASSERT_EQ(moved->lines.size(), 1u);
    EXPECT_THAT(moved->lines[0], HasSubstr("overlap at the start; "));
}

TEST(MoveApart, WhatIsHeldStays) {
    const auto model =
        make_blocks({{.pins = {HalfSpaceRegion{{1, 0, 0}, 0.05}}}, {.place = {0.02, 0.25, -0.02}}});
    const auto moved = move_apart(model, model->positions);
    ASSERT_TRUE(moved.has_value());
    EXPECT_EQ(overlaps_of(*model, moved->positions), 0u);
    EXPECT_EQ(motion_of(*model, 0, *moved), glm::vec3(0.0f));
    EXPECT_GT(motion_of(*model, 1, *moved).y, 0.04f);
}

// A tower on a floor, each block a little within the one below: all go up.
TEST(MoveApart, NothingGoesBelowAPlane) {
    ColliderDescription floor;
    floor.shape = PlaneCollider{{0, 1, 0}, 0.0};
    std::vector<Block> blocks;
    for (int k = 0; k < 6; ++k) blocks.push_back({.place = {0.0, 0.29 * k, 0.0}});
    const auto model = make_blocks(blocks, {0, 0, 0}, {floor});
    const auto moved = move_apart(model, model->positions);
    ASSERT_TRUE(moved.has_value());
    EXPECT_EQ(overlaps_of(*model, moved->positions), 0u);
    const auto lowest = [](const std::vector<glm::vec4>& positions) {
        return std::ranges::min(positions, {}, &glm::vec4::y).y;
    };
    EXPECT_GE(lowest(moved->positions), std::min(0.0f, lowest(model->positions)) - 1e-6f);
}

// In one place, and through a collider.
TEST(MoveApart, FromAnywhere) {
    ColliderDescription wall;
    wall.shape = BoxShape{{0.02, 3.0, 3.0}};
    wall.position = {0.1, 0.0, 0.0};
    for (unsigned seed = 1; seed <= 12; ++seed) {
        test::RandomMaker random(seed);
        std::vector<Block> blocks;
        for (int k = random.integer(2, 5); k > 0; --k) {
            Block block;
            block.place = random.integer(0, 3) == 0 ? glm::dvec3(0.0) : random.point(0.3);
            block.size = {random.uniform(0.05, 0.4), random.uniform(0.05, 0.4), random.uniform(0.05, 0.4)};
            block.cells = {2, 2, 2};
            blocks.push_back(block);
        }
        const auto model = seed % 2 == 0 ? make_blocks(blocks, {0, 0, 0}, {wall}) : make_blocks(blocks);
        const auto moved = move_apart(model, model->positions);
        EXPECT_EQ(overlaps_of(*model, moved ? moved->positions : model->positions), 0u) << seed;
    }
}

Scene overlapping_balls() {
    Scene scene;
    scene.collision.response = CollisionResponse::contact;
    scene.simulation.gravity = {0, 0, 0};
    scene.materials.resize(1);
    scene.materials[0].name = "jelly";
    for (const char* name : {"left", "right"}) {
        ObjectDescription ball;
        ball.name = name;
        ball.material = "jelly";
        ball.shape = SphereShape{0.3, 3};
        ball.position = {scene.objects.empty() ? -0.2 : 0.2, 0, 0};
        scene.objects.push_back(ball);
    }
    return scene;
}

TEST(MoveApart, ASimulationStartsThere) {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator simulator(overlapping_balls(), options);
    const std::vector<float> start = simulator.read_frame().positions;
    EXPECT_LT(*std::min_element(start.begin(), start.end()), -0.51f);
    for (int frame = 0; frame < 5; ++frame) simulator.advance_frame();
    simulator.reset();
    EXPECT_EQ(simulator.read_frame().positions, start);
}

TEST(MoveApart, WhatCannotMoveIsNamed) {
    Scene scene = overlapping_balls();
    for (ObjectDescription& ball : scene.objects) ball.pins = {HalfSpaceRegion{{0, 1, 0}, 0.0}};
    SimulatorOptions options;
    options.backend = Backend::cpu;
    try {
        const Simulator simulator(scene, options);
        FAIL() << "held bodies that overlap were accepted";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("'left' and 'right' overlap"));
    }
}

}  // namespace
}  // namespace gelatin
