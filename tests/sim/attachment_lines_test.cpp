#include "sim/attachment_lines.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gelatin/simulator.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

// Two rigid boxes beside each other, and nothing else.
Scene two_boxes() {
    Scene scene;
    scene.simulation.gravity = glm::dvec3(0.0);
    scene.materials.push_back({});
    scene.materials[0].name = "wood";
    for (int i = 0; i < 2; ++i) {
        ObjectDescription box;
        box.name = "box " + std::to_string(i);
        box.shape = BoxShape{{0.4, 0.4, 0.4}, {1, 1, 1}};
        box.material = "wood";
        box.position = {0.5 * i, 0.0, 0.0};
        box.rigid.emplace();
        scene.objects.push_back(box);
    }
    return scene;
}

std::vector<OverlayLine> lines_of(const AttachmentDescription& attachment, bool is_broken = false) {
    Scene scene = two_boxes();
    scene.attachments.push_back(attachment);
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator simulator(scene, options);
    if (is_broken) simulator.detach(0);
    return attachment_lines(SimulatorInternals::attachments(simulator), model_of(simulator),
                            simulator.positions());
}

void expect_near(const glm::vec4& found, const glm::vec3& expected) {
    EXPECT_LT(glm::distance(glm::vec3(found), expected), 1e-5f)
        << found.x << " " << found.y << " " << found.z;
}

// Both sides carry the point, each with other weights.
TEST(AttachmentLines, APointIsWhereItWasAttached) {
    const auto lines = lines_of({.object = "box 0", .to = "box 1", .where = AttachedPoint{{0.25, 0.1, 0.0}}});
    const OverlayLine& point = lines.back();
    EXPECT_EQ(point.from.w, OverlayLine::kAttached);
    expect_near(point.from, {0.25f, 0.1f, 0.0f});
    EXPECT_EQ(point.to, glm::vec4(glm::vec3(point.from), 0.0f));
    for (std::size_t l = 0; l + 1 < lines.size(); ++l) EXPECT_EQ(lines[l].from.w, 1.0f) << "its rounding";
}

TEST(AttachmentLines, ADistanceHasBothPointsAndALineBetweenThem) {
    const auto lines = lines_of(
        {.object = "box 0", .to = "box 1", .where = AttachedDistance{{0.0, 0.2, 0.0}, {0.5, 0.2, 0.1}}});
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].from.w, 1.0f);
    expect_near(lines[0].from, {0.0f, 0.2f, 0.0f});
    expect_near(lines[0].to, {0.5f, 0.2f, 0.1f});
    expect_near(lines[1].from, {0.0f, 0.2f, 0.0f});
    expect_near(lines[2].from, {0.5f, 0.2f, 0.1f});
}

TEST(AttachmentLines, JointsHaveTheirAxes) {
    const auto axes_of = [](const AttachmentDescription& attachment) {
        std::vector<glm::vec3> axes;
        for (const OverlayLine& line : lines_of(attachment))
            if (line.from.w == 2.0f)
                axes.push_back(glm::normalize(glm::vec3(line.to) - glm::vec3(line.from)));
        return axes;
    };
    const auto hinge = axes_of(
        {.object = "box 0", .to = "box 1", .where = AttachedLine{{0.25, 0.0, -0.1}, {0.25, 0.0, 0.1}}});
    ASSERT_EQ(hinge.size(), 1u);
    EXPECT_LT(glm::distance(hinge[0], glm::vec3(0.0f, 0.0f, 1.0f)), 1e-5f);
    const auto slider = axes_of({.object = "box 0", .where = AttachedRail{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}});
    ASSERT_EQ(slider.size(), 1u);
    EXPECT_LT(glm::distance(slider[0], glm::vec3(0.0f, 1.0f, 0.0f)), 1e-5f);
    const auto universal =
        axes_of({.object = "box 0",
                 .to = "box 1",
                 .where = AttachedUniversal{{0.25, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}});
    ASSERT_EQ(universal.size(), 2u);
    EXPECT_LT(glm::distance(universal[0], glm::vec3(0.0f, 0.0f, 1.0f)), 1e-5f) << "of the other side";
    EXPECT_LT(glm::distance(universal[1], glm::vec3(0.0f, 1.0f, 0.0f)), 1e-5f) << "of the object";
}

TEST(AttachmentLines, WhatIsBrokenHasNone) {
    EXPECT_TRUE(lines_of({.object = "box 0", .where = AttachedPoint{{0.0, 0.0, 0.0}}}, true).empty());
}

}  // namespace
}  // namespace gelatin
