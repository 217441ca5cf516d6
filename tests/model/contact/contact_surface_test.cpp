#include "model/contact/contact_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "model/assembly/build_model.h"
#include "model/corners.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

TEST(ContactSurface, KnowsWhatIsAcrossEveryEdge) {
    const Model model = test::make_lively_model();
    const ContactSurface surface = make_contact_surface(model, {.friction = 0.4});
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
    const ContactSurface surface = make_contact_surface(model, {.friction = 0.4});
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
        make_contact_surface(pack_bodies({fine, coarse}, {}, {0.0, 0.0, 0.0}), {.friction = 0.4});
    EXPECT_NEAR(surface.reach(0, 0), 0.01, 1e-8);
    EXPECT_NEAR(surface.reach(0, 1), 0.02, 1e-8);
}

TEST(ContactSurface, KnowsWhatMaterialsAndPairsSay) {
    Body ice = test::make_body(test::make_block({1, 1, 1}, {0.1, 0.1, 0.1}));
    Body rubber = ice, plain = ice;
    ice.material.name = "ice";
    ice.material.friction = 0.1;
    ice.material.thickness = 0.002;
    rubber.material.name = "rubber";
    rubber.material.friction = 0.9;
    rubber.material.contact_stiffness = 4.0;
    plain.material.name = "plain";
    CollisionSettings collision;
    collision.friction = 0.4;
    const Model model = pack_bodies({ice, rubber, plain, ice}, {}, {0.0, 0.0, 0.0});
    const ContactSurface alone = make_contact_surface(model, collision);
    EXPECT_NEAR(alone.touch(0, 1).friction, 0.3, 1e-12);  // the geometric mean
    EXPECT_NEAR(alone.touch(1, 0).stiffness, 2.0, 1e-12);
    EXPECT_NEAR(alone.touch(2, 2).friction, 0.4, 1e-12);
    EXPECT_NEAR(alone.touch(2, 2).stiffness, 1.0, 1e-12);
    EXPECT_NEAR(alone.reach(0, 3), 0.004, 1e-12);
    collision.pairs = {{"rubber", "ice", 0.5, {}}, {"ice", "ice", {}, 7.0}};
    const ContactSurface paired = make_contact_surface(model, collision);
    for (const auto& [a, b] : {std::pair{0u, 1u}, std::pair{1u, 0u}, std::pair{3u, 1u}}) {
        EXPECT_NEAR(paired.touch(a, b).friction, 0.5, 1e-12);
        EXPECT_NEAR(paired.touch(a, b).stiffness, 2.0, 1e-12);
    }
    EXPECT_NEAR(paired.touch(0, 3).friction, 0.1, 1e-12);
    EXPECT_NEAR(paired.touch(0, 3).stiffness, 7.0, 1e-12);
    EXPECT_NEAR(paired.touch(1, 2).friction, 0.6, 1e-12);
}

// At a collider the body's stiffness counts, and the collider's friction.
TEST(ContactSurface, CollidersHaveTheirOwnFriction) {
    Scene scene;
    scene.collision.response = CollisionResponse::contact;
    for (const double friction : {0.2, 0.7}) {
        ColliderDescription collider;
        collider.shape = SphereShape{0.1, 1};
        collider.friction = friction;
        scene.colliders.push_back(collider);
    }
    Body body = test::make_body(test::make_block({1, 1, 1}, {0.1, 0.1, 0.1}));
    body.material.friction = 0.9;
    body.material.contact_stiffness = 3.0;
    const Model model = pack_bodies({body}, {}, {0.0, 0.0, 0.0}, make_collider_surfaces(scene));
    const ContactSurface surface = make_contact_surface(model, scene.collision);
    EXPECT_NEAR(surface.touch(0, 1).friction, 0.2, 1e-12);
    EXPECT_NEAR(surface.touch(2, 0).friction, 0.7, 1e-12);
    EXPECT_NEAR(surface.touch(0, 1).stiffness, 3.0, 1e-12);
    EXPECT_NEAR(surface.touch(1, 0).stiffness, 3.0, 1e-12);
}

}  // namespace
}  // namespace gelatin
