#include "viewer/attach_tool.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gelatin/error.h"
#include "sim/simulator_internals.h"

namespace gelatin::viewer {
namespace {

// Two cubes of 0.4 m with a gap between them, seen from in front, and a floor.
Scene two_blocks(double gap) {
    Scene scene;
    scene.simulation.gravity = glm::dvec3(0.0);
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    for (int i = 0; i < 2; ++i) {
        ObjectDescription block;
        block.name = i == 0 ? "left" : "right";
        block.shape = BoxShape{{0.4, 0.4, 0.4}, {4, 4, 4}};
        block.material = "jelly";
        block.position = {(0.4 + gap) * (i - 0.5), 1.0, 0.0};
        scene.objects.push_back(block);
    }
    ColliderDescription floor;
    floor.shape = PlaneCollider{};
    scene.colliders.push_back(floor);
    return scene;
}

Simulator simulate_on_cpu(const Scene& scene) {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    return Simulator(scene, options);
}

Ray ray_to(const glm::vec3& point) {
    const glm::vec3 eye(0.0f, 1.2f, 5.0f);
    return {eye, glm::normalize(point - eye)};
}

std::optional<std::string> click_at(AttachTool& tool, Simulator& simulator, const glm::vec3& point,
                                    bool is_rope = false) {
    tool.click(ray_to(point), is_rope);
    return tool.follow(simulator);
}

const AttachmentDescription& last_of(const Simulator& simulator) {
    return simulator.scene().attachments.back();
}

TEST(AttachTool, JoinsTwoBodiesByARodOrARope) {
    for (const bool is_rope : {false, true}) {
        Simulator simulator = simulate_on_cpu(two_blocks(0.2));
        AttachTool tool;
        tool.begin();
        EXPECT_FALSE(click_at(tool, simulator, {0.0f, 3.0f, 0.0f})) << "no body is there";
        EXPECT_FALSE(tool.first_point());
        EXPECT_FALSE(click_at(tool, simulator, {-0.3f, 1.0f, 0.2f}));
        ASSERT_TRUE(tool.first_point());
        EXPECT_LT(glm::distance(*tool.first_point(), glm::vec3(-0.3f, 1.0f, 0.2f)), 1e-5f);
        const auto made = click_at(tool, simulator, {0.3f, 1.1f, 0.2f}, is_rope);
        EXPECT_EQ(made, is_rope ? "rope 1: 'left' to 'right'" : "rod 1: 'left' to 'right'");
        EXPECT_FALSE(tool.is_active());
        ASSERT_EQ(simulator.attachments().size(), 1u);
        const auto& distance = std::get<AttachedDistance>(last_of(simulator).where);
        EXPECT_LT(glm::distance(distance.from, glm::dvec3(-0.3, 1.0, 0.2)), 1e-5);
        EXPECT_LT(glm::distance(distance.to, glm::dvec3(0.3, 1.1, 0.2)), 1e-5);
        EXPECT_EQ(last_of(simulator).limits.has_value(), is_rope);
    }
}

TEST(AttachTool, JoinsThemInAPointWhereTheyAreTogether) {
    Simulator simulator = simulate_on_cpu(two_blocks(0.01));
    AttachTool tool;
    tool.begin();
    click_at(tool, simulator, {-0.01f, 1.0f, 0.2f});
    EXPECT_EQ(click_at(tool, simulator, {0.01f, 1.0f, 0.2f}), "joint 1: 'left' to 'right'");
    EXPECT_LT(glm::distance(std::get<AttachedPoint>(last_of(simulator).where).at, glm::dvec3(0.0, 1.0, 0.2)),
              1e-5);
}

TEST(AttachTool, AttachesToSpaceAndToAFloor) {
    Simulator simulator = simulate_on_cpu(two_blocks(0.2));
    AttachTool tool;
    tool.begin();
    click_at(tool, simulator, {-0.3f, 1.0f, 0.2f});
    EXPECT_EQ(click_at(tool, simulator, {0.0f, 3.0f, 0.0f}), "joint 1: 'left' to space");
    EXPECT_LT(glm::distance(std::get<AttachedPoint>(last_of(simulator).where).at, glm::dvec3(-0.3, 1.0, 0.2)),
              1e-5);
    tool.begin();
    click_at(tool, simulator, {-0.3f, 1.0f, 0.2f});
    EXPECT_EQ(click_at(tool, simulator, {0.0f, 0.0f, 1.0f}), "rod 1: 'left' to space");
    EXPECT_LT(
        glm::distance(std::get<AttachedDistance>(last_of(simulator).where).to, glm::dvec3(0.0, 0.0, 1.0)),
        1e-4);
}

TEST(AttachTool, RefusesABodyAndItself) {
    Simulator simulator = simulate_on_cpu(two_blocks(0.2));
    AttachTool tool;
    tool.begin();
    click_at(tool, simulator, {-0.3f, 1.0f, 0.2f});
    EXPECT_THROW(click_at(tool, simulator, {-0.4f, 1.1f, 0.2f}), InvalidInput);
    EXPECT_FALSE(tool.is_active());
    EXPECT_TRUE(simulator.attachments().empty());
}

// The first point moves with its body until the second click.
TEST(AttachTool, FollowsTheBody) {
    Scene scene = two_blocks(0.2);
    scene.objects[0].velocity = {0.0, 1.0, 0.0};
    Simulator simulator = simulate_on_cpu(scene);
    AttachTool tool;
    tool.begin();
    click_at(tool, simulator, {-0.3f, 1.0f, 0.2f});
    for (int f = 0; f < 6; ++f) simulator.advance_frame();
    tool.follow(simulator);
    EXPECT_NEAR(tool.first_point()->y, 1.0 + simulator.time(), 1e-3);
}

// What is saved refers to where bodies are at the start.
TEST(AttachTool, WhatItMakesIsKnownAtTheStart) {
    Scene scene = two_blocks(0.2);
    scene.objects[0].velocity = {0.0, 1.0, 0.0};
    Simulator simulator = simulate_on_cpu(scene);
    for (int f = 0; f < 6; ++f) simulator.advance_frame();
    const auto rise = static_cast<float>(simulator.time());
    AttachTool tool;
    const auto at_start = [&] {
        const std::size_t last = simulator.attachments().size() - 1;
        return moved_attachment(last_of(simulator), SimulatorInternals::attachments(simulator)[last],
                                model_of(simulator), model_of(simulator).positions);
    };
    tool.begin();
    click_at(tool, simulator, {-0.3f, 1.0f + rise, 0.2f});
    ASSERT_TRUE(click_at(tool, simulator, {0.3f, 1.0f, 0.2f}));
    const auto distance = std::get<AttachedDistance>(at_start().where);
    EXPECT_LT(glm::distance(distance.from, glm::dvec3(-0.3, 1.0, 0.2)), 1e-3);
    EXPECT_LT(glm::distance(distance.to, glm::dvec3(0.3, 1.0, 0.2)), 1e-3);
    tool.begin();
    click_at(tool, simulator, {-0.3f, 1.0f + rise, 0.2f});
    ASSERT_TRUE(click_at(tool, simulator, {0.0f, 4.0f, 0.0f}));
    EXPECT_LT(glm::distance(std::get<AttachedPoint>(at_start().where).at, glm::dvec3(-0.3, 1.0, 0.2)), 1e-3);
}

// A joint whose sides are apart at the start becomes a rod.
TEST(AttachTool, AJointThatIsApartElsewhereIsADistanceThere) {
    Simulator simulator = simulate_on_cpu(two_blocks(0.01));
    AttachTool tool;
    tool.begin();
    click_at(tool, simulator, {-0.01f, 1.0f, 0.2f});
    ASSERT_TRUE(click_at(tool, simulator, {0.01f, 1.0f, 0.2f}));
    std::vector<glm::vec4> apart = model_of(simulator).positions;
    const Range& nodes = model_of(simulator).objects[0].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) apart[n].y += 0.3f;
    const Attachment& made = SimulatorInternals::attachments(simulator)[0];
    const auto distance = std::get<AttachedDistance>(
        moved_attachment(last_of(simulator), made, model_of(simulator), apart).where);
    EXPECT_NEAR(glm::distance(distance.from, distance.to), 0.3, 1e-5);
}

}  // namespace
}  // namespace gelatin::viewer
