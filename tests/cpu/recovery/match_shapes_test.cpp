#include "cpu/recovery/match_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <random>
#include <string>

#include "cpu/implicit/system_solver.h"
#include "support/lost_shapes.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

struct ObjectMomenta {
    glm::dvec3 linear{0.0}, angular{0.0};  // about the origin
};

ObjectMomenta object_momenta(const Model& model, const ModelObject& object, const cpu::Nodes<double>& nodes) {
    ObjectMomenta sum;
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        const glm::dvec3 p = static_cast<double>(model.masses[n]) * glm::dvec3(nodes.velocities[n]);
        sum.linear += p;
        sum.angular += glm::cross(glm::dvec3(nodes.positions[n]), p);
    }
    return sum;
}

double worst_strain(const Model& model, const ModelObject& object, const cpu::Nodes<double>& nodes) {
    double worst = 0.0;
    for (std::uint32_t s = object.springs.first; s < object.springs.end(); ++s) {
        const Spring& spring = model.springs[s];
        const double length =
            glm::distance(glm::dvec3(nodes.positions[spring.i]), glm::dvec3(nodes.positions[spring.j]));
        worst = std::max(worst, std::abs(length / static_cast<double>(spring.rest_length) - 1.0));
    }
    return worst;
}

cpu::Nodes<double> in_double(const cpu::Nodes<float>& nodes) {
    return {{nodes.positions.begin(), nodes.positions.end()},
            {nodes.velocities.begin(), nodes.velocities.end()}};
}

cpu::Nodes<double> matched(const Model& model, cpu::Nodes<double> nodes) {
    cpu::ShapeMatcher<double>(std::make_shared<const Model>(model)).run(nodes, 1.0 / 60.0);
    return nodes;
}

TEST(ShapeMatcher, GivesLostShapesBackWithTheirMomentum) {
    const Model model = test::make_bodies_to_lose();
    const cpu::Nodes<double> before = in_double(test::lose_shapes(model, true)),
                             after = matched(model, before);
    for (const std::size_t o : {0, 1}) {
        const ModelObject& object = model.objects[o];
        EXPECT_GT(worst_strain(model, object, before), 1.0);
        EXPECT_LT(worst_strain(model, object, after), 1e-5);
        const ObjectMomenta had = object_momenta(model, object, before),
                            has = object_momenta(model, object, after);
        EXPECT_LT(glm::distance(has.linear, had.linear), 1e-6 * glm::length(had.linear));
        EXPECT_LT(glm::distance(has.angular, had.angular), 1e-6 * glm::length(had.angular));
    }
}

TEST(ShapeMatcher, LeavesHeldNodes) {
    const Model model = test::make_bodies_to_lose();
    const cpu::Nodes<double> before = in_double(test::lose_shapes(model, true)),
                             after = matched(model, before);
    int held = 0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        if (model.positions[n].w > 0.0f) continue;
        ++held;
        EXPECT_EQ(after.positions[n], before.positions[n]);
        EXPECT_EQ(after.velocities[n], before.velocities[n]);
    }
    EXPECT_GT(held, 0);
}

// A bar of 2 m along x from 0 in any of these shapes keeps it.
TEST(ShapeMatcher, LeavesWhatIsOnlyDeformed) {
    const Model model = test::make_bodies_to_lose();
    constexpr auto kPi = std::numbers::pi;
    const auto rotated = [](const glm::dvec3& p, double angle) {
        const double y = p.y - 1.05, z = p.z - 0.05, c = std::cos(angle), s = std::sin(angle);
        return glm::dvec3(p.x, c * y - s * z, s * y + c * z);
    };
    const std::vector<glm::dvec3 (*)(const glm::dvec3&)> maps = {
        [](const glm::dvec3& p) { return glm::dvec3(p.x, 0.0, p.z); },
        [](const glm::dvec3& p) { return glm::dvec3(-p.x, p.y, p.z); },
        [](const glm::dvec3& p) { return 0.01 * p; },
        [](const glm::dvec3& p) {
            return glm::dvec3((0.32 + p.y) * std::sin(kPi * p.x), (0.32 + p.y) * std::cos(kPi * p.x), p.z);
        },
    };
    std::vector<cpu::Nodes<double>> shapes;
    for (const auto& map : maps) {
        cpu::Nodes<double>& nodes = shapes.emplace_back(in_double({model.positions, model.velocities}));
        for (glm::dvec4& p : nodes.positions) p = glm::dvec4(map(glm::dvec3(p)), p.w);
    }
    cpu::Nodes<double>& twisted = shapes.emplace_back(in_double({model.positions, model.velocities}));
    for (glm::dvec4& p : twisted.positions) p = glm::dvec4(rotated(glm::dvec3(p), 2.0 * kPi * p.x), p.w);
    for (std::size_t k = 0; k < shapes.size(); ++k)
        EXPECT_EQ(matched(model, shapes[k]).positions, shapes[k].positions) << "shape " << k;
}

// Parts of what unfolds from a line would stay inverted.
TEST(ShapeMatcher, GivesLinesTheirShapeBack) {
    const Model model = test::make_bodies_to_lose();
    cpu::Nodes<double> line = in_double({model.positions, model.velocities});
    for (glm::dvec4& p : line.positions) p = glm::dvec4(p.x, 0.0, 0.0, p.w);
    const Range& bar = model.objects[1].nodes;
    const cpu::Nodes<double> found = matched(model, line);
    for (std::uint32_t n = bar.first; n < bar.end(); ++n)
        for (std::uint32_t m = bar.first; m < n; ++m)
            EXPECT_NEAR(glm::distance(glm::dvec3(found.positions[n]), glm::dvec3(found.positions[m])),
                        glm::distance(glm::dvec3(model.positions[n]), glm::dvec3(model.positions[m])), 1e-6);
}

// What is crushed may seem to be lost for a while.
TEST(ShapeMatcher, WaitsUnlessNodesWereSetFromOutside) {
    const auto model = std::make_shared<const Model>(test::make_bodies_to_lose());
    const cpu::Nodes<double> whole = in_double({model->positions, model->velocities}),
                             lost = in_double(test::lose_shapes(*model, true));
    cpu::ShapeMatcher<double> matcher(model);
    const auto matches = [&](cpu::Nodes<double> nodes) { return !matcher.run(nodes, 0.1).empty(); };
    EXPECT_TRUE(matches(lost));
    EXPECT_FALSE(matches(whole));
    for (int k = 0; k < 5; ++k) EXPECT_FALSE(matches(lost)) << k;  // half a second
    EXPECT_TRUE(matches(lost));
    EXPECT_FALSE(matches(whole));
    EXPECT_FALSE(matches(lost));
    matcher.forget();
    EXPECT_TRUE(matches(lost));
}

TEST(ShapeMatcher, GoesOnFromACheckpoint) {
    const auto model = std::make_shared<const Model>(test::make_bodies_to_lose());
    const cpu::Nodes<double> lost = in_double(test::lose_shapes(*model, true));
    cpu::ShapeMatcher<double> matcher(model), other(model);
    const auto matches = [](cpu::ShapeMatcher<double>& with, cpu::Nodes<double> nodes, double elapsed) {
        return !with.run(nodes, elapsed).empty();
    };
    EXPECT_FALSE(matches(matcher, in_double({model->positions, model->velocities}), 0.1));
    EXPECT_FALSE(matches(matcher, lost, 0.4));
    std::string bytes;
    Archive written = Archive::that_writes(bytes);
    matcher.archive(written);
    Archive read = Archive::that_reads(bytes);
    other.archive(read);
    EXPECT_TRUE(read.is_complete());
    EXPECT_FALSE(matches(other, lost, 0.05));
    EXPECT_TRUE(matches(other, lost, 0.1));
}

// A soft block that comes down so hard that it seems to be lost is left to its elements.
TEST(ShapeMatcher, LeavesHardImpacts) {
    Body body = test::make_body(test::make_block({5, 5, 5}, {0.5, 0.5, 0.5}, 0.2));
    body.material.youngs_modulus = 1e4;
    body.velocity = {2.0, -8.0, 0.0};
    ColliderDescription floor;
    floor.shape = PlaneCollider{{0.0, 1.0, 0.0}, -0.1};
    const auto model = std::make_shared<const Model>(pack_bodies({body}, {floor}, {0.0, -9.81, 0.0}));
    cpu::SystemSolver<float> solver(model, {}, {.iterations = 20});
    int lost = 0;
    for (int s = 0; s < 24; ++s) {
        solver.advance({1.0 / 60.0});
        cpu::Nodes<float> nodes = solver.nodes();
        lost += cpu::ShapeMatcher<float>(model).run(nodes, 1.0 / 60.0).empty() ? 0 : 1;
    }
    EXPECT_GT(lost, 3);
    glm::dvec3 momentum(0.0);
    double motion = 0.0, mass = 0.0;
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        const glm::dvec3 v(solver.nodes().velocities[n]);
        const auto m = static_cast<double>(model->masses[n]);
        mass += m;
        momentum += m * v;
        motion += 0.5 * m * glm::dot(v, v);
    }
    // It vibrates: with its shape put back it would not.
    EXPECT_GT(motion - 0.5 * glm::dot(momentum, momentum) / mass, 0.02 * motion);
}

}  // namespace
}  // namespace gelatin
