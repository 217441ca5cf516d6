#include "viewer/picking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/shapes.h"
#include "model/assembly/build_model.h"
#include "model/assembly/collider_surface.h"
#include "support/test_models.h"

namespace gelatin::viewer {
namespace {

std::vector<float> positions_of(const Model& model) {
    std::vector<float> positions;
    for (const glm::vec4& p : model.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
    return positions;
}

// Two blocks of a metre, one behind the other along z, with their faces at z = 1 and z = -1.
Model two_blocks() {
    std::vector<Body> bodies;
    for (const double z : {0.0, -2.0}) {
        Body& body = bodies.emplace_back(test::make_body(test::make_block({4, 4, 4}, {1.0, 1.0, 1.0})));
        for (glm::dvec3& p : body.mesh.positions) p.z += z;
    }
    return pack_bodies(bodies, {}, glm::dvec3(0.0));
}

TEST(Picking, FindsTheNearestFace) {
    const Model model = two_blocks();
    const std::vector<float> positions = positions_of(model);
    const glm::vec3 direction = glm::normalize(glm::vec3(0.02f, 0.03f, -1.0f));
    const auto found = pick({{0.3f, 0.4f, 5.0f}, direction}, positions, model.faces);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->object, 0u);
    EXPECT_NEAR(found->point.z, 1.0f, 1e-5f);
    EXPECT_NEAR(found->point.x, 0.3f + 0.02f * 4.0f, 1e-5f);
    EXPECT_NEAR(found->distance, 4.0f / -direction.z, 1e-5f);
    const Face& face = model.faces[found->face];
    for (const std::uint32_t n : {face.a, face.b, face.c}) EXPECT_EQ(model.positions[n].z, 1.0f);

    const auto behind = pick({{0.3f, 0.4f, -5.0f}, {0.0f, 0.0f, 1.0f}}, positions, model.faces);
    ASSERT_TRUE(behind);
    EXPECT_EQ(behind->object, 1u);
}

// Its near wall is not drawn.
TEST(Picking, ReachesIntoARoom) {
    ColliderDescription room;
    room.shape = Shape{BoxShape{glm::dvec3(3)}};
    room.position = glm::dvec3(0.5);
    Scene scene;
    scene.collision.response = CollisionResponse::contact;
    scene.colliders = {room};
    const Model model = pack_bodies({test::make_body(test::make_block({4, 4, 4}, {1.0, 1.0, 1.0}))}, {},
                                    glm::dvec3(0.0), make_collider_surfaces(scene));
    const std::vector<float> positions = positions_of(model);
    const auto found = pick({{0.3f, 0.4f, 5.0f}, {0.0f, 0.0f, -1.0f}}, positions, model.faces);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->object, 0u);
    const auto beside = pick({{1.3f, 0.4f, 5.0f}, {0.0f, 0.0f, -1.0f}}, positions, model.faces);
    ASSERT_TRUE(beside);
    EXPECT_FALSE(model.is_body(beside->object));
    EXPECT_NEAR(beside->point.z, -1.0f, 1e-5f) << "the far wall";
}

TEST(Picking, MissesWhatIsBesideAndBehind) {
    const Model model = two_blocks();
    const std::vector<float> positions = positions_of(model);
    EXPECT_FALSE(pick({{1.3f, 0.4f, 5.0f}, {0.0f, 0.0f, -1.0f}}, positions, model.faces));
    EXPECT_FALSE(pick({{0.3f, 0.4f, 5.0f}, {0.0f, 0.0f, 1.0f}}, positions, model.faces));
    EXPECT_FALSE(pick({{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}, positions, std::vector<Face>{}));
}

TEST(Picking, AHandHoldsTheBodyRoundThePoint) {
    const Model model = two_blocks();
    const std::vector<float> positions = positions_of(model);
    const auto found = pick({{0.3f, 0.4f, 5.0f}, {0.0f, 0.0f, -1.0f}}, positions, model.faces);
    ASSERT_TRUE(found);
    const Pull pull = take_hold(model, positions, *found);
    double stiffness = 0.0;
    for (const Pull::Node& held : pull.nodes) {
        EXPECT_LT(held.node, model.objects[0].nodes.end());
        EXPECT_LE(glm::distance(held.arm + glm::vec3(pull.target), glm::vec3(model.positions[held.node])),
                  1e-6f);
        EXPECT_GT(held.stiffness, 0.0f);
        stiffness += static_cast<double>(held.stiffness);
    }
    EXPECT_NEAR(stiffness, model.objects[0].mass * kHandRate * kHandRate, 1e-3 * stiffness);
    EXPECT_NEAR(pull.damping_time, 2.0 * std::sqrt(model.objects[0].mass / stiffness), 1e-6);
    EXPECT_LT(pull.nodes.size(), model.objects[0].nodes.count);
}

// However coarse the mesh is.
TEST(Picking, AHandHoldsTheFaceAtLeast) {
    const Model model = test::make_model(test::make_body(test::make_block({1, 1, 1}, {1.0, 1.0, 1.0})));
    const std::vector<float> positions = positions_of(model);
    const auto found = pick({{0.4f, 0.3f, 5.0f}, {0.0f, 0.0f, -1.0f}}, positions, model.faces);
    ASSERT_TRUE(found);
    const Pull pull = take_hold(model, positions, *found);
    const Face& face = model.faces[found->face];
    for (const std::uint32_t n : {face.a, face.b, face.c}) {
        EXPECT_TRUE(std::any_of(pull.nodes.begin(), pull.nodes.end(),
                                [&](const Pull::Node& held) { return held.node == n; }));
    }
}

// A ball of which the hull is a block of two tets' thickness.
TEST(Picking, ASkinIsPickedAndItsTetsAreHeld) {
    Body body = test::make_body(test::make_block({1, 1, 1}, {1.0, 1.0, 1.0}));
    SurfaceMesh ball = make_sphere({0.9, 6});
    for (glm::dvec3& p : ball.positions) p += 0.5;
    body.skin = std::make_shared<const ShapeSkin>(
        ShapeSkin{ball.faces, carry_surface(ball, body.mesh).vertices, 0.4});
    const Model model = test::make_model(body);
    const std::vector<float> positions = positions_of(model);
    const std::vector<float> points = drawn_positions(model, positions);
    ASSERT_EQ(drawn_faces(model).size(), ball.faces.size());
    const auto found = pick({{0.45f, 0.55f, 5.0f}, {0.0f, 0.0f, -1.0f}}, points, drawn_faces(model));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->point.z, 1.4f, 0.02f);
    const Pull pull = take_hold(model, positions, *found);
    const Face& face = drawn_faces(model)[found->face];
    for (const std::uint32_t corner : {face.a, face.b, face.c}) {
        const SkinPoint& point = model.skin.points[corner];
        for (const std::uint32_t n : {point.a, point.b, point.c, point.d}) {
            EXPECT_TRUE(std::any_of(pull.nodes.begin(), pull.nodes.end(),
                                    [&](const Pull::Node& held) { return held.node == n; }));
        }
    }
}

// Wherever the body is now, what is pinned are its nodes.
TEST(Picking, TheFirmestHalfIsPinned) {
    const Model model = two_blocks();
    std::vector<float> positions = positions_of(model);
    for (std::size_t k = 1; k < positions.size(); k += 3) positions[k] += 7.0f;
    const auto found = pick({{0.3f, 7.4f, 5.0f}, {0.0f, 0.0f, -1.0f}}, positions, model.faces);
    ASSERT_TRUE(found);
    const Pull pull = take_hold(model, positions, *found);
    const SphereRegion region = region_of(pull, model);
    std::size_t count = 0;
    for (const Pull::Node& held : pull.nodes)
        count +=
            glm::distance(glm::dvec3(model.positions[held.node]), region.center) <= region.radius ? 1 : 0;
    EXPECT_GT(count, 0u);
    EXPECT_LT(count, pull.nodes.size());
    EXPECT_LT(glm::distance(region.center, glm::dvec3(found->point) - glm::dvec3(0.0, 7.0, 0.0)), 0.5);
}

}  // namespace
}  // namespace gelatin::viewer
