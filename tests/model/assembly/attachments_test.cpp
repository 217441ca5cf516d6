#include "model/assembly/attachments.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numeric>
#include <set>

#include "gelatin/error.h"
#include "model/assembly/build_model.h"

namespace gelatin::attachments_test {
namespace {

ObjectDescription box(const std::string& name, const glm::dvec3& position) {
    ObjectDescription object;
    object.name = name;
    object.shape = BoxShape{{0.2, 0.2, 0.2}};
    object.mesher.kind = MesherKind::lattice;
    object.mesher.nodes = 200;
    object.material = "jelly";
    object.position = position;
    return object;
}

// Two cubes beside each other, 4 mm apart, between a floor, a plate that moves and one that does not.
Scene cubes() {
    Scene scene;
    scene.simulation.solver = SolverKind::implicit;
    Material material;
    material.name = "jelly";
    scene.materials = {material};
    scene.objects = {box("a", {0.0, 0.104, 0.0}), box("b", {0.204, 0.104, 0.0})};
    ColliderDescription floor, moving, resting;
    floor.shape = PlaneCollider{};
    floor.name = "floor";
    moving.shape = BoxShape{{0.2, 0.1, 0.2}};
    moving.name = "moving";
    moving.position = {0.0, 0.258, 0.0};
    moving.keyframes = {{0.0}, {1.0, {0.0, 1.0, 0.0}}};
    resting = moving;
    resting.name = "resting";
    resting.position.x = 0.204;
    resting.keyframes = {};
    scene.colliders = {floor, moving, resting};
    return scene;
}

Attachment make(const Scene& scene, const AttachmentDescription& description) {
    Scene with = scene;
    with.attachments = {description};
    validate(with);
    const Model model = build_model(with);
    return make_attachment(description, 0, with, model, model.positions);
}

std::string error_of(const Scene& scene, const AttachmentDescription& description) {
    try {
        make(scene, description);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "";
}

// Whether ties do what Tie says, at the start.
void expect_kept(const Model& model, const Attachment& made) {
    const Range& own = model.objects[made.object].nodes;
    for (const Tie& tie : made.ties) {
        glm::dvec3 sum(0.0);
        double of_own = 0.0, of_other = 0.0;
        for (std::uint32_t k = 0; k < tie.count; ++k) {
            const bool is_own = tie.nodes[k] >= own.first && tie.nodes[k] < own.end();
            const auto weight = static_cast<double>(tie.weights[k]);
            (is_own ? of_own : of_other) += weight;
            sum += weight * glm::dvec3(model.positions[tie.nodes[k]]);
        }
        EXPECT_NEAR(of_own, 1.0, 1e-6);
        EXPECT_TRUE(of_other == 0.0 || std::abs(of_other + 1.0) < 1e-6);
        EXPECT_EQ(of_other == 0.0, made.is_in_space);
        EXPECT_LT(glm::distance(sum, glm::dvec3(tie.at)), 1e-6);
    }
}

TEST(MakeAttachment, TiesNodesThatAreNear) {
    const Scene scene = cubes();
    const Model model = build_model(scene);
    const Attachment made = make(scene, {.object = "b", .to = "a"});
    EXPECT_EQ(made.name, "attachment 1");
    EXPECT_EQ(made.object, 1u);
    EXPECT_EQ(made.other, 0u);
    EXPECT_EQ(made.break_force, std::numeric_limits<float>::infinity());
    std::set<std::uint32_t> tied;
    for (const Tie& tie : made.ties) {
        EXPECT_NEAR(model.positions[tie.nodes[0]].x, 0.104f, 1e-4f) << "the side towards the other";
        tied.insert(tie.nodes[0]);
    }
    std::size_t on_side = 0;
    for (std::uint32_t n = model.objects[1].nodes.first; n < model.objects[1].nodes.end(); ++n)
        if (model.positions[n].x < 0.1041f) ++on_side;
    EXPECT_EQ(tied.size(), on_side);
    EXPECT_EQ(made.ties.size(), on_side);
    expect_kept(model, made);
}

TEST(MakeAttachment, TiesNodesOfARegion) {
    const Scene scene = cubes();
    const Model model = build_model(scene);
    const Attachment made =
        make(scene,
             {.name = "hook", .object = "a", .where = HalfSpaceRegion{{0, -1, 0}, -0.2}, .break_force = 5.0});
    EXPECT_EQ(made.name, "hook");
    EXPECT_EQ(made.other, kNoNode);
    EXPECT_EQ(made.break_force, 5.0f);
    for (const Tie& tie : made.ties) {
        EXPECT_EQ(tie.count, 1u);
        EXPECT_GE(tie.at.y, 0.2f);
    }
    expect_kept(model, made);
}

// Both sides carry the points of a joint.
TEST(MakeAttachment, TiesPointsAndLines) {
    const Scene scene = cubes();
    const Model model = build_model(scene);
    const glm::dvec3 middle(0.102, 0.15, 0.01), end(0.102, 0.15, -0.09);
    const Attachment ball = make(scene, {.object = "a", .to = "b", .where = AttachedPoint{middle}});
    ASSERT_EQ(ball.ties.size(), 1u);
    expect_kept(model, ball);
    const Attachment hinge = make(scene, {.object = "a", .to = "b", .where = AttachedLine{middle, end}});
    EXPECT_GE(hinge.ties.size(), 3u);
    expect_kept(model, hinge);
    for (std::size_t t = 0; t < hinge.ties.size(); ++t) {
        glm::dvec3 place(0.0);
        for (std::uint32_t k = 0; k < hinge.ties[t].count; ++k)
            if (hinge.ties[t].nodes[k] < model.objects[0].nodes.end())
                place += static_cast<double>(hinge.ties[t].weights[k]) *
                         glm::dvec3(model.positions[hinge.ties[t].nodes[k]]);
        const double part = static_cast<double>(t) / static_cast<double>(hinge.ties.size() - 1);
        EXPECT_LT(glm::distance(place, glm::mix(middle, end, part)), 1e-6);
    }
}

// A collider that moves carries with its nodes; one that rests is space; a plane is known.
TEST(MakeAttachment, TiesToColliders) {
    const Scene scene = cubes();
    const Model model = build_model(scene);
    const Attachment moving = make(scene, {.object = "a", .to = "moving"});
    EXPECT_EQ(moving.other, 2u);
    for (const Tie& tie : moving.ties) EXPECT_GT(tie.count, 1u);
    expect_kept(model, moving);
    const Attachment resting = make(scene, {.object = "b", .to = "resting"});
    EXPECT_EQ(resting.other, 3u);
    for (const Tie& tie : resting.ties) EXPECT_EQ(tie.count, 1u);
    expect_kept(model, resting);
    const Attachment floor = make(scene, {.object = "b", .to = "floor"});
    EXPECT_EQ(floor.other, kNoNode);
    EXPECT_EQ(floor.plane, 0u);
    EXPECT_FALSE(floor.ties.empty());
}

TEST(MakeAttachment, SaysWhatIsWrong) {
    const Scene scene = cubes();
    EXPECT_EQ(error_of(scene, {.object = "a", .where = HalfSpaceRegion{{0, 1, 0}, -1.0}}),
              "attachment[0].region: holds no node of 'a' (regions are in world coordinates at the start)");
    Scene far = scene;
    far.objects[1].position.x = 0.5;
    EXPECT_TRUE(
        error_of(far, {.object = "b", .to = "a"}).starts_with("attachment[0].to: 'b' has no node within "));
    EXPECT_TRUE(error_of(scene, {.object = "a", .to = "b", .where = AttachedPoint{{0.0, 3.0, 0.0}}})
                    .starts_with("attachment[0].point: [0, 3, 0] is farther than "));
    Scene flat = scene;
    flat.colliders[1].shape = MeshShape{std::make_shared<const Mesh>(Mesh{
        {{-0.1, 0, -0.1}, {0.1, 0, -0.1}, {0.1, 0, 0.1}, {-0.1, 0, 0.1}}, {{0, 2, 1}, {0, 3, 2}}, {}, {}})};
    flat.colliders[1].position.y = 0.208;
    EXPECT_EQ(error_of(flat, {.object = "a", .to = "moving"}),
              "attachment[0].to: must not be flat, as 'moving' is, and move");
}

}  // namespace
}  // namespace gelatin::attachments_test
