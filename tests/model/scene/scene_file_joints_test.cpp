#include "model/scene/scene_file_fixture.h"

namespace gelatin::test {
namespace {

// Two rigid bodies; an attachment's own lines start on line 7.
class SceneFileJoints : public SceneFile {
protected:
    static std::string with(const std::string& lines) {
        return "material = [{name = 'wood'}]\n"
               "rigid = [{name = 'door', shape = {box = [1, 1, 1]}}, {name = 'wall', shape = {sphere = 1}}]\n"
               "[[attachment]]\nname = 'hinge'\nobject = 'door'\nto = 'wall'\n" +
               lines + "\n";
    }
    std::string joint_error(const std::string& lines) { return error(with(lines)); }
};

TEST_F(SceneFileJoints, ReadsWhereTheyAre) {
    const Scene scene = load(with(R"(rail = [[0, 1, 0], [0, 2, 0.5]]
[[attachment]]
object = "door"
to = "wall"
universal = { point = [1, 2, 3], own = [0, 0, 2], of_other = [0, 1, 0] }
[[attachment]]
object = "door"
distance = [[0, 1, 0], [0, 3, 0]])"));
    ASSERT_EQ(scene.attachments.size(), 3u);
    const auto& rail = std::get<AttachedRail>(scene.attachments[0].where);
    EXPECT_EQ(rail.from, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(rail.to, glm::dvec3(0.0, 2.0, 0.5));
    const auto& universal = std::get<AttachedUniversal>(scene.attachments[1].where);
    EXPECT_EQ(universal.at, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(universal.own, glm::dvec3(0.0, 0.0, 2.0));
    EXPECT_EQ(universal.of_other, glm::dvec3(0.0, 1.0, 0.0));
    const auto& distance = std::get<AttachedDistance>(scene.attachments[2].where);
    EXPECT_EQ(distance.from, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(distance.to, glm::dvec3(0.0, 3.0, 0.0));
    for (const AttachmentDescription& attachment : scene.attachments)
        EXPECT_FALSE(attachment.limits || attachment.spring || attachment.motor);
}

TEST_F(SceneFileJoints, ReadsLimitsSpringsAndMotors) {
    const Scene scene = load(with(R"(line = [[0, 0, 0], [0, 1, 0]]
limits = [-10, 90.5]
spring = { stiffness = 5, damping = 0.5, rest = 45 }
motor = { speed = 30, position = 60, force = 7, keyframes = [
    { time = 1, speed = 40 },
    { time = 2.5, position = -5, force = 0 },
] }
[[attachment]]
object = "door"
rail = [[0, 0, 0], [0, 1, 0]]
spring = { damping = 2 }
motor = { speed = 0 })"));
    const AttachmentDescription &hinge = scene.attachments.at(0), &slider = scene.attachments.at(1);
    EXPECT_EQ(hinge.limits, glm::dvec2(-10.0, 90.5));
    EXPECT_EQ(hinge.spring->stiffness, 5.0);
    EXPECT_EQ(hinge.spring->damping, 0.5);
    EXPECT_EQ(hinge.spring->rest, 45.0);
    EXPECT_EQ(hinge.motor->speed, 30.0);
    EXPECT_EQ(hinge.motor->position, 60.0);
    EXPECT_EQ(hinge.motor->force, 7.0);
    ASSERT_EQ(hinge.motor->keyframes.size(), 2u);
    EXPECT_EQ(hinge.motor->keyframes[0].time, 1.0);
    EXPECT_EQ(hinge.motor->keyframes[0].speed, 40.0);
    EXPECT_FALSE(hinge.motor->keyframes[0].position || hinge.motor->keyframes[0].force);
    EXPECT_EQ(hinge.motor->keyframes[1].time, 2.5);
    EXPECT_EQ(hinge.motor->keyframes[1].position, -5.0);
    EXPECT_EQ(hinge.motor->keyframes[1].force, 0.0);
    EXPECT_FALSE(hinge.motor->keyframes[1].speed);
    EXPECT_FALSE(slider.limits);
    EXPECT_EQ(slider.spring->stiffness, 0.0);
    EXPECT_EQ(slider.spring->damping, 2.0);
    EXPECT_FALSE(slider.spring->rest);
    EXPECT_EQ(slider.motor->speed, 0.0);
    EXPECT_FALSE(slider.motor->position || slider.motor->force);
    EXPECT_TRUE(slider.motor->keyframes.empty());
}

TEST_F(SceneFileJoints, CanBeOverridden) {
    const std::string text = with(
        "line = [[0, 0, 0], [0, 1, 0]]\nspring = {stiffness = 5}\n"
        "motor = {speed = 30, keyframes = [{time = 1, speed = 40}]}");
    const Scene scene =
        load(text, {"attachment.hinge.motor.speed=90", "attachment.hinge.limits=[0, 90]",
                    "attachment.hinge.spring.rest=10", "attachment.0.motor.keyframes.0.time=3"});
    const AttachmentDescription& hinge = scene.attachments.at(0);
    EXPECT_EQ(hinge.motor->speed, 90.0);
    EXPECT_EQ(hinge.motor->keyframes[0].time, 3.0);
    EXPECT_EQ(hinge.motor->keyframes[0].speed, 40.0);
    EXPECT_EQ(hinge.limits, glm::dvec2(0.0, 90.0));
    EXPECT_EQ(hinge.spring->stiffness, 5.0);
    EXPECT_EQ(hinge.spring->rest, 10.0);
    // A table that the file does not have.
    EXPECT_EQ(load(with("line = [[0, 0, 0], [0, 1, 0]]"), {"attachment.hinge.motor.speed=90"})
                  .attachments.at(0)
                  .motor->speed,
              90.0);
    EXPECT_EQ(error(text, {"attachment.hinge.motor.force=-1"}),
              "--set attachment.hinge.motor.force=-1: attachment.hinge.motor.force = -1: must be 0 or more");
}

TEST_F(SceneFileJoints, RefusesWrongKeysAndTypes) {
    const std::string line = "line = [[0, 0, 0], [0, 1, 0]]\n";
    EXPECT_EQ(
        joint_error("rail = [[0, 1, 0]]"),
        "scene.toml:7: attachment.hinge.rail = [[0, 1, 0]]: must be two points: [[x, y, z], [x, y, z]]");
    EXPECT_EQ(joint_error("distance = 3"),
              "scene.toml:7: attachment.hinge.distance = 3: must be two points: [[x, y, z], [x, y, z]]");
    EXPECT_EQ(joint_error("universal = {point = [0, 0, 0], own = [1, 0, 0]}"),
              "scene.toml:7: attachment.hinge.universal: needs \"of_other\"");
    EXPECT_EQ(joint_error("universal = [0, 0, 0]"),
              "scene.toml:7: attachment.hinge.universal = [0, 0, 0]: must be a table, is a list");
    EXPECT_EQ(joint_error(line + "limits = 90"),
              "scene.toml:8: attachment.hinge.limits = 90: must be a list of 2 numbers, is a whole number");
    EXPECT_EQ(joint_error(line + "limits = [0, 1, 2]"),
              "scene.toml:8: attachment.hinge.limits = [0, 1, 2]: must be a list of 2 numbers, has 3");
    EXPECT_EQ(joint_error(line + "limits = [0, 'x']"),
              "scene.toml:8: attachment.hinge.limits[1] = \"x\": must be a number, is a string");
    EXPECT_EQ(joint_error(line + "spring = {stifness = 3}"),
              "scene.toml:8: attachment.hinge.spring.stifness = 3: unknown key (did you mean "
              "\"stiffness\"?)");
    EXPECT_EQ(joint_error(line + "motor = {torque = 3}"),
              "scene.toml:8: attachment.hinge.motor.torque = 3: unknown key; known here are speed, position, "
              "force and keyframes");
    EXPECT_EQ(joint_error(line + "motor = {speed = 3, keyframes = [{speed = 2}]}"),
              "scene.toml:8: attachment.hinge.motor.keyframes[0]: needs \"time\"");
    EXPECT_EQ(joint_error(line + "motor = {speed = 3, keyframes = [{time = 0, turn = 2}]}"),
              "scene.toml:8: attachment.hinge.motor.keyframes[0].turn = 2: unknown key; known here are time, "
              "speed, position and force");
    EXPECT_EQ(joint_error(line + "rail = [[0, 0, 0], [0, 1, 0]]"),
              "scene.toml:3: attachment.hinge: must have at most one of region, point, line, rail, universal "
              "or distance, has line and rail");
}

TEST_F(SceneFileJoints, NamesTheLineOfAWrongValue) {
    EXPECT_EQ(joint_error("line = [[0, 0, 0], [0, 1, 0]]\n[attachment.motor]\nspeed = 3\nposition = 5\n"
                          "[[attachment.motor.keyframes]]\ntime = 2\nspeed = -1"),
              "scene.toml:13: attachment.hinge.motor.keyframes[0].speed = -1: must be greater than 0 where "
              "there is a position");
}

}  // namespace
}  // namespace gelatin::test
