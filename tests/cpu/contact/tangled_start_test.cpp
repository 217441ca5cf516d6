#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <set>
#include <utility>

#include "cpu/implicit/system_solver.h"
#include "exact/triangle_overlap.h"
#include "model/corners.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// A soft bar, bent to a ring of which the ends go through each other at rest, with a floor under it.
std::shared_ptr<const Model> make_ring() {
    Body body = test::make_body(test::make_block({24, 2, 2}, {2.4, 0.2, 0.2}));
    for (glm::dvec3& p : body.mesh.positions) {
        const double angle = p.x / 0.375, radius = 0.6 - p.y;
        p = {radius * std::cos(angle), 0.7 + radius * std::sin(angle), p.z + 0.03 * angle};
    }
    body.material.youngs_modulus = 2e3;
    std::vector<ColliderDescription> floor(1);
    floor[0].shape = PlaneCollider{};
    return std::make_shared<const Model>(pack_bodies({body}, floor, {0, -9.81, 0}));
}

// Which edges pass through which faces, without a common node, in exact arithmetic.
std::set<std::pair<std::uint32_t, std::uint32_t>> find_piercings(
    const Model& model, const std::vector<cpu::Vec4<float>>& positions) {
    const auto at = [&](std::uint32_t n) { return glm::dvec3(positions[n]); };
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    const auto& edges = model.surface_parts.edges;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const glm::dvec3 a = at(edges[e].a), b = at(edges[e].b);
        for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
            const Face& face = model.faces[f];
            if (has_corner(face, edges[e].a) || has_corner(face, edges[e].b)) continue;
            const glm::dvec3 p = at(face.a), q = at(face.b), r = at(face.c);
            if (glm::any(glm::greaterThan(glm::min(a, b), glm::max(glm::max(p, q), r))) ||
                glm::any(glm::lessThan(glm::max(a, b), glm::min(glm::min(p, q), r))))
                continue;  // their boxes are apart
            if (test::exactly_overlap({a, b, b}, {p, q, r})) found.emplace(e, f);
        }
    }
    return found;
}

// The ring falls on the floor and collapses. Its ends go on as they began; nothing else goes through
// anything.
TEST(TangledStart, StaysAsItIs) {
    const auto model = make_ring();
    cpu::SystemSolver<float> solver(
        model, CollisionSettings{.response = CollisionResponse::contact, .self_collision = true});
    const auto start = find_piercings(*model, solver.nodes().positions);
    EXPECT_THAT(start, ::testing::SizeIs(::testing::Gt(2u)));
    float lowest = 1.0f;  // that its highest node ever is
    for (int frame = 0; frame < 60; ++frame) {
        solver.advance({1.0 / 60.0});
        const auto& positions = solver.nodes().positions;
        if (frame % 6 == 5) {
            EXPECT_EQ(find_piercings(*model, positions), start);
        }
        const auto highest = std::max_element(positions.begin(), positions.end(),
                                              [](const auto& a, const auto& b) { return a.y < b.y; });
        lowest = std::min(lowest, highest->y);
    }
    EXPECT_LT(lowest, 0.8f);  // of 1.3
}

}  // namespace
}  // namespace gelatin
