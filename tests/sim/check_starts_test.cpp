#include "sim/check_starts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "gelatin/error.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A block of 1 x 0.4 x 1 m from the origin on, with a floor beneath it at `height`, and a sphere far away.
std::vector<std::string> check(double height, const std::vector<Region>& pins = {}) {
    Scene scene;
    scene.colliders.resize(2);
    scene.colliders[0].shape = SphereShape{0.5};
    scene.colliders[0].position = {9.0, 0.0, 0.0};
    scene.colliders[1].shape = PlaneCollider{{0.0, 1.0, 0.0}, height};
    Body body = test::make_body(test::make_block({3, 2, 3}, {1.0, 0.4, 1.0}));
    body.name = "jelly";
    body.pins = pins;
    const Model model = pack_bodies({body}, scene.colliders, {0.0, 0.0, 0.0});
    return check_starts(model, scene, model.positions);
}

TEST(CheckStarts, HasNothingToSayOutsideAndNotDeepInside) {
    EXPECT_THAT(check(-0.1), IsEmpty());
    EXPECT_THAT(check(0.19), IsEmpty());
}

TEST(CheckStarts, TellsOfObjectsDeepInside) {
    EXPECT_THAT(check(0.25),
                ElementsAre("object 'jelly': starts 0.25 m deep inside collider 2 (a plane), which "
                            "may tear it as its nodes are pushed out; up to 0.2 m, half of its "
                            "thickness there, is safe"));
}

TEST(CheckStarts, LooksAtFreeNodesAlone) {
    EXPECT_THAT(check(0.25, {HalfSpaceRegion{{0.0, 1.0, 0.0}, 1.0}}), IsEmpty());
}

// A bar whose ends go through each other.
TEST(CheckStarts, NamesWhatPassesThroughItself) {
    Body body = test::make_body(test::make_block({12, 2, 2}, {2.4, 0.2, 0.2}));
    body.name = "ring";
    const auto model =
        std::make_shared<const Model>(pack_bodies({body}, std::vector<ColliderDescription>{}, {0, 0, 0}));
    std::vector<glm::vec4> positions = model->positions;
    EXPECT_THAT(find_tangled(model, positions), IsEmpty());
    for (glm::vec4& p : positions) {
        const float angle = 3.0f * p.x, radius = 0.4f + p.y;
        p = glm::vec4(radius * std::cos(angle), radius * std::sin(angle), p.z, p.w);
    }
    EXPECT_THAT(find_tangled(model, positions),
                ElementsAre(::testing::StartsWith("object 'ring' passes through itself at the start, in ")));
    Scene scene;
    scene.collision.response = CollisionResponse::contact;
    EXPECT_NO_THROW(require_apart(model, scene, positions));
}

}  // namespace
}  // namespace gelatin
