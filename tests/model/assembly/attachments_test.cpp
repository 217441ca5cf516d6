#include "model/assembly/attachments.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
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

// The same with two rigid cubes in the place of both.
Scene rigid_cubes() {
    Scene scene = cubes();
    for (ObjectDescription& object : scene.objects) {
        object.mesher = {};
        object.rigid.emplace();
    }
    return scene;
}

// Of the joint, when the object's nodes are where `place` says of where they are at the start.
double coordinate_at(const Scene& scene, const Attachment& made,
                     const std::function<glm::dvec3(const glm::dvec3&)>& place) {
    const Model model = build_model(scene);
    std::vector<glm::dvec4> positions(model.positions.begin(), model.positions.end());
    const Range& own = model.objects[made.object].nodes;
    for (std::uint32_t n = own.first; n < own.end(); ++n)
        positions[n] = glm::dvec4(place(glm::dvec3(positions[n])), positions[n].w);
    const std::span<const glm::dvec4> at = positions;
    return coordinate(made.joint, frame_of(made.joint.own, at), frame_of(made.joint.other, at));
}

glm::dvec3 itself(const glm::dvec3& p) {
    return p;
}

// Both frames are the same at the start, with z along the line.
void expect_same_frames(const Model& model, const Joint& joint, const Frame& expected) {
    const std::span<const glm::vec4> at = model.positions;
    for (const CarriedFrame* carried : {&joint.own, &joint.other}) {
        const Frame frame = frame_of(*carried, at);
        EXPECT_LT(glm::distance(frame.point, expected.point), 1e-6);
        EXPECT_LT(glm::distance(frame.axes[2], expected.axes[2]), 1e-6);
        EXPECT_LT(glm::distance(frame.axes[0], frame_of(joint.other, at).axes[0]), 1e-6);
        EXPECT_NEAR(glm::determinant(frame.axes), 1.0, 1e-6);
    }
}

constexpr double kFloat = 1e-5;  // what is left of frames that float nodes carry

TEST(MakeAttachment, AHingeOfRigidSidesHasAnAngle) {
    const Scene scene = rigid_cubes();
    const Model model = build_model(scene);
    const glm::dvec3 from(0.102, 0.1, -0.1), to(0.102, 0.1, 0.1);
    for (const char* other : {"b", "moving", "resting", "floor", ""}) {
        const Attachment made = make(scene, {.object = "a", .to = other, .where = AttachedLine{from, to}});
        EXPECT_EQ(made.joint.kind, Joint::Kind::hinge);
        EXPECT_TRUE(made.joint.has_coordinate());
        EXPECT_GE(made.ties.size(), 2u);
        expect_same_frames(model, made.joint, {from, {{}, {}, {0, 0, 1}}});
        EXPECT_NEAR(coordinate_at(scene, made, itself), 0.0, kFloat) << other;
        const auto turned = [&](double degrees) {
            const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
            return [=](const glm::dvec3& p) {
                const glm::dvec3 arm = p - from;
                return from + glm::dvec3(c * arm.x - s * arm.y, s * arm.x + c * arm.y, arm.z);
            };
        };
        EXPECT_NEAR(coordinate_at(scene, made, turned(30.0)), glm::radians(30.0), kFloat);
        EXPECT_NEAR(coordinate_at(scene, made, turned(-170.0)), glm::radians(-170.0), kFloat);
    }
    EXPECT_EQ(make(cubes(), {.object = "a", .to = "b", .where = AttachedLine{from, to}}).joint.kind,
              Joint::Kind::none)
        << "of deformable sides";
}

TEST(MakeAttachment, ASliderHasALength) {
    const Scene scene = rigid_cubes();
    const Model model = build_model(scene);
    const glm::dvec3 from(0.0, 0.1, 0.0), to(3.0, 4.1, 0.0);
    const Attachment made = make(scene, {.object = "a", .to = "b", .where = AttachedRail{from, to}});
    EXPECT_EQ(made.joint.kind, Joint::Kind::slider);
    EXPECT_TRUE(made.ties.empty());
    expect_same_frames(model, made.joint, {from, {{}, {}, {0.6, 0.8, 0.0}}});
    EXPECT_NEAR(coordinate_at(scene, made, itself), 0.0, kFloat);
    EXPECT_NEAR(coordinate_at(scene, made, [](const glm::dvec3& p) { return p + glm::dvec3(0.3, 0.4, 9.0); }),
                0.5, kFloat);
}

TEST(MakeAttachment, AUniversalJointHasTwoAxes) {
    const Scene scene = rigid_cubes();
    const Model model = build_model(scene);
    const glm::dvec3 at(0.1, 0.2, 0.3);
    const Attachment made = make(
        scene, {.object = "a", .to = "b", .where = AttachedUniversal{at, {0.0, 0.0, 2.0}, {0.0, 3.0, 0.0}}});
    EXPECT_EQ(made.joint.kind, Joint::Kind::universal);
    EXPECT_FALSE(made.joint.has_coordinate());
    EXPECT_EQ(made.ties.size(), 1u);
    expect_same_frames(model, made.joint, {at, {{}, {}, {0, 1, 0}}});
    const std::span<const glm::vec4> positions = model.positions;
    EXPECT_LT(glm::distance(frame_of(made.joint.own, positions).axes[0], glm::dvec3(0, 0, 1)), 1e-6);
}

// Of deformable bodies, too.
TEST(MakeAttachment, ADistanceIsBetweenTwoPoints) {
    const glm::dvec3 from(0.0, 0.15, 0.0), to(0.204, 0.15, 0.1);
    for (const Scene& scene : {cubes(), rigid_cubes()}) {
        for (const char* other : {"b", ""}) {
            const Attachment made =
                make(scene, {.object = "a", .to = other, .where = AttachedDistance{from, to}});
            EXPECT_EQ(made.joint.kind, Joint::Kind::distance);
            EXPECT_TRUE(made.ties.empty());
            EXPECT_TRUE(made.joint.is_kept);
            EXPECT_DOUBLE_EQ(made.joint.rest, glm::distance(from, to));
            EXPECT_NEAR(coordinate_at(scene, made, itself), glm::distance(from, to), kFloat);
            const glm::dvec3 apart(0.0, 1.0, 0.0);
            EXPECT_NEAR(coordinate_at(scene, made, [&](const glm::dvec3& p) { return p + apart; }),
                        glm::distance(from + apart, to), kFloat);
        }
    }
    EXPECT_TRUE(error_of(cubes(), {.object = "a", .to = "b", .where = AttachedDistance{from, {0, 9, 0}}})
                    .starts_with("attachment[0].distance: [0, 9, 0] is farther than "));
}

TEST(MakeAttachment, AnglesOfTheSceneAreDegrees) {
    const Scene scene = rigid_cubes();
    const AttachmentDescription hinge{.object = "a",
                                      .where = AttachedLine{{0, 0.1, 0}, {0, 0.1, 1}},
                                      .limits = glm::dvec2(-90, 180),
                                      .spring = JointSpring{5.0, 0.5, 45.0}};
    const Joint angle = make(scene, hinge).joint;
    EXPECT_LT(glm::distance(angle.limits, glm::radians(glm::dvec2(-90, 180))), 1e-12);
    EXPECT_EQ(angle.stiffness, 5.0);
    EXPECT_EQ(angle.damping, 0.5);
    EXPECT_DOUBLE_EQ(angle.rest, glm::radians(45.0));

    AttachmentDescription slider = hinge;
    slider.where = AttachedRail{{0, 0.1, 0}, {0, 0.1, 1}};
    const Joint length = make(scene, slider).joint;
    EXPECT_EQ(length.limits, glm::dvec2(-90, 180));
    EXPECT_EQ(length.rest, 45.0);
    slider.limits = {};
    slider.spring = {};
    EXPECT_EQ(make(scene, slider).joint.limits, glm::dvec2(-Joint::kNoLimit, Joint::kNoLimit));

    const Joint rope = make(scene, {.object = "a",
                                    .where = AttachedDistance{{0, 0.1, 0}, {0, 2.1, 0}},
                                    .limits = glm::dvec2(0, 2),
                                    .spring = JointSpring{5.0}})
                           .joint;
    EXPECT_FALSE(rope.is_kept);
    EXPECT_DOUBLE_EQ(rope.rest, 2.0);
    EXPECT_EQ(rope.limits, glm::dvec2(0, 2));
}

TEST(MotorAt, FollowsKeyframes) {
    const AttachmentDescription slider{.object = "a", .where = AttachedRail{}};
    const JointMotor motor{.speed = 2.0, .keyframes = {{1.0, {}, 5.0}, {2.0, 3.0, {}, 7.0}}};
    const MotorTarget start = motor_at(slider, motor, 0.999), middle = motor_at(slider, motor, 1.0),
                      end = motor_at(slider, motor, 50.0);
    EXPECT_TRUE(start.acts);
    EXPECT_EQ(start.speed, 2.0);
    EXPECT_FALSE(start.position);
    EXPECT_EQ(start.force, Joint::kNoLimit);
    EXPECT_EQ(middle.speed, 2.0);
    EXPECT_EQ(middle.position, 5.0);
    EXPECT_EQ(end.speed, 3.0);
    EXPECT_EQ(end.position, 5.0);
    EXPECT_EQ(end.force, 7.0);
}

TEST(MotorAt, TurnsDegreesIntoRadians) {
    const AttachmentDescription hinge{.object = "a", .where = AttachedLine{}};
    const MotorTarget target = motor_at(hinge, {.speed = 180.0, .position = -90.0, .force = 3.0}, 0.0);
    EXPECT_DOUBLE_EQ(target.speed, glm::radians(180.0));
    EXPECT_DOUBLE_EQ(*target.position, glm::radians(-90.0));
    EXPECT_EQ(target.force, 3.0);
    EXPECT_EQ(motor_at(hinge, {.position = 1.0}, 0.0).speed, Joint::kNoLimit);
}

TEST(JoinedBodies, AreThoseOfJointsButDistances) {
    Scene scene = rigid_cubes();
    scene.attachments = {{.object = "b", .to = "a", .where = AttachedRail{{0, 0, 0}, {0, 1, 0}}}};
    EXPECT_TRUE(are_joined(joined_bodies(scene, build_model(scene)), 0, 1));
    scene.attachments[0].where = AttachedDistance{{0, 0, 0}, {0, 1, 0}};
    EXPECT_TRUE(joined_bodies(scene, build_model(scene)).empty());
}

TEST(MakeAttachment, SaysWhatIsWrong) {
    const Scene scene = cubes();
    EXPECT_EQ(error_of(scene, {.object = "a", .where = HalfSpaceRegion{{0, 1, 0}, -1.0}}),
              "attachment[0].region: holds no node of 'a' (regions are in world coordinates)");
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
    Scene rod = scene;  // forty times as long as it is thick
    rod.colliders[1].shape = Shape{BoxShape{{0.02, 0.02, 0.8}}};
    rod.colliders[1].position.y = 0.208;
    EXPECT_EQ(error_of(rod, {.object = "a", .to = "moving", .where = AttachedPoint{{0.0, 0.2, 0.0}}}), "");
}

}  // namespace
}  // namespace gelatin::attachments_test
