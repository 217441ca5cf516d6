#include "model/contact/contact_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/build/build_model.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

std::array<std::uint32_t, 3> corners_of(const Face& face) {
    return {face.a, face.b, face.c};
}

TEST(ContactSurface, KnowsWhatIsAcrossEveryEdge) {
    const Model model = test::make_lively_model();
    const ContactSurface surface = make_contact_surface(model, 0.4);
    ASSERT_EQ(surface.across.size(), 3 * model.faces.size());
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
        const auto corners = corners_of(model.faces[f]);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const CornerAcross& across = surface.across[3 * f + k];  // a closed surface
            ASSERT_NE(across.face, f);
            const auto others = corners_of(model.faces.at(across.face));
            for (const std::uint32_t n : {corners[k], corners[(k + 1) % 3], across.corner})
                EXPECT_EQ(std::count(others.begin(), others.end(), n), 1);
            EXPECT_EQ(std::count(corners.begin(), corners.end(), across.corner), 0);
        }
    }
    ASSERT_EQ(surface.beside_edges.size(), model.surface_parts.edges.size());
    for (std::size_t e = 0; e < surface.beside_edges.size(); ++e) {
        const FaceEdge& edge = model.surface_parts.edges[e];
        const glm::uvec2& beside = surface.beside_edges[e];
        EXPECT_NE(beside.x, beside.y);
        for (const std::uint32_t corner : {beside.x, beside.y}) {
            const bool is_face = std::any_of(model.faces.begin(), model.faces.end(), [&](const Face& face) {
                auto nodes = corners_of(face);
                auto wanted = std::array{edge.a, edge.b, corner};
                std::sort(nodes.begin(), nodes.end());
                std::sort(wanted.begin(), wanted.end());
                return nodes == wanted;
            });
            EXPECT_TRUE(is_face);
        }
    }
}

TEST(ContactSurface, ListsSurfaceNodesAlone) {
    const Model model = test::make_lively_model();
    const ContactSurface surface = make_contact_surface(model, 0.4);
    std::size_t count = 0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        if (surface.places[n] == kNoNode) continue;
        EXPECT_EQ(model.surface_parts.nodes[surface.places[n]], n);
        ++count;
    }
    EXPECT_EQ(count, model.surface_parts.nodes.size());
    EXPECT_LT(count, model.node_count());
}

// Of blocks of cells of 0.1 and 0.3 m, whose faces are halved squares: more straight edges than diagonals.
TEST(ContactSurface, ReachesATenthOfTheMedianEdges) {
    const Body fine = test::make_body(test::make_block({4, 4, 4}, {0.4, 0.4, 0.4}));
    const Body coarse = test::make_body(test::make_block({2, 2, 2}, {0.6, 0.6, 0.6}));
    const ContactSurface surface =
        make_contact_surface(pack_bodies({fine, coarse}, {}, {0.0, 0.0, 0.0}), 0.4);
    EXPECT_NEAR(surface.reach(0, 0), 0.01, 1e-8);
    EXPECT_NEAR(surface.reach(0, 1), 0.02, 1e-8);
}

}  // namespace
}  // namespace gelatin
