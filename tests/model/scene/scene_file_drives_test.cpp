#include "model/scene/scene_file_fixture.h"

namespace gelatin::test {
namespace {

class SceneFileDrives : public SceneFile {
protected:
    // A handle's or load's own lines start on line 6.
    static std::string with(const std::string& table, const std::string& lines) {
        return "material = [{name = 'jelly'}]\n[[object]]\nname = 'bar'\nshape = {box = [1, 1, 1]}\n" +
               table + "\n" + lines + "\n";
    }
    std::string handle_error(const std::string& lines) { return error(with("[[object.handle]]", lines)); }
    std::string load_error(const std::string& lines) { return error(with("[[object.load]]", lines)); }
};

TEST_F(SceneFileDrives, ReadsHandles) {
    const Scene scene = load(with("[[object.handle]]", R"(region = { plane = [2, 0, 0], offset = -0.4 }
pivot = [0, 1, 2]
interpolation = "smooth"
release = 3.5
keyframes = [ { time = 0 }, { time = 2, move = [0, 0.1, 0], turn = [720, 0, 0], scale = 2 } ]
when_blocked = "stops"
drag = { move = [0.5, 0, 0], turn = [0, 0, 90] }

[[object.handle]]
region = { sphere = [1, 0, 0], radius = 0.1 })"));
    ASSERT_EQ(scene.objects.at(0).handles.size(), 2u);
    const HandleDescription& handle = scene.objects[0].handles[0];
    EXPECT_EQ(std::get<HalfSpaceRegion>(handle.region).normal, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(handle.pivot, glm::dvec3(0.0, 1.0, 2.0));
    EXPECT_EQ(handle.interpolation, Interpolation::smooth);
    EXPECT_EQ(handle.release, 3.5);
    EXPECT_EQ(handle.line, 5);
    ASSERT_EQ(handle.keyframes.size(), 2u);
    EXPECT_EQ(handle.keyframes[1].time, 2.0);
    EXPECT_EQ(handle.keyframes[1].move, glm::dvec3(0.0, 0.1, 0.0));
    EXPECT_EQ(handle.keyframes[1].turn, glm::dvec3(720.0, 0.0, 0.0));
    EXPECT_EQ(handle.keyframes[1].scale, 2.0);
    EXPECT_EQ(handle.when_blocked, WhenBlocked::stops);
    EXPECT_EQ(handle.drag.move, glm::dvec3(0.5, 0.0, 0.0));
    EXPECT_EQ(handle.drag.turn, glm::dvec3(0.0, 0.0, 90.0));
    const HandleDescription& silent = scene.objects[0].handles[1];
    EXPECT_FALSE(silent.pivot);
    EXPECT_FALSE(silent.release);
    EXPECT_EQ(silent.interpolation, Interpolation::linear);
    EXPECT_TRUE(silent.keyframes.empty());
    EXPECT_EQ(silent.when_blocked, WhenBlocked::goes_on);
    EXPECT_EQ(silent.drag.move, glm::dvec3(0.0));
    EXPECT_EQ(silent.line, 14);
}

TEST_F(SceneFileDrives, ReadsLoadsAndSpin) {
    const Scene scene = load(with("spin = [0, 90, 0]", R"([[object.load]]
region = { box = [[0, 0, 0], [1, 1, 1]] }
force = [1, 2, 3]
[[object.load]]
region = { plane = [0, 1, 0] }
traction = [0, -100, 0]
from = 1
[[object.load]]
region = { plane = [0, 1, 0] }
pressure = -50
from = 1
until = 2)"));
    const std::vector<LoadDescription>& loads = scene.objects.at(0).loads;
    ASSERT_EQ(loads.size(), 3u);
    EXPECT_EQ(scene.objects[0].spin, glm::dvec3(0.0, 90.0, 0.0));
    EXPECT_EQ(std::get<ForceLoad>(loads[0].kind).sum, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_FALSE(loads[0].from || loads[0].until);
    EXPECT_EQ(std::get<TractionLoad>(loads[1].kind).stress, glm::dvec3(0.0, -100.0, 0.0));
    EXPECT_EQ(loads[1].from, 1.0);
    EXPECT_EQ(std::get<PressureLoad>(loads[2].kind).pressure, -50.0);
    EXPECT_EQ(loads[2].until, 2.0);
    EXPECT_EQ(loads[2].line, 13);
}

TEST_F(SceneFileDrives, CopiesHaveThemToo) {
    const Scene scene =
        load(with("spin = [0, 90, 0]\ncopies = {counts = [2, 1, 1], spacing = [2, 0, 0]}",
                  "[[object.load]]\nregion = {plane = [1, 0, 0], offset = 9}\nforce = [1, 0, 0]"));
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[1].spin, glm::dvec3(0.0, 90.0, 0.0));
    EXPECT_EQ(scene.objects[1].loads.size(), 1u);
}

TEST_F(SceneFileDrives, CanBeOverridden) {
    const std::string text = with("[[object.handle]]",
                                  "region = {plane = [1, 0, 0]}\nkeyframes = [{time = 0}, "
                                  "{time = 1, turn = [90, 0, 0]}]\n[[object.load]]\n"
                                  "region = {plane = [1, 0, 0]}\nforce = [1, 0, 0]");
    const Scene scene = load(text, {"object.bar.handle.0.release=2", "object.bar.handle.0.keyframes.1.time=5",
                                    "object.bar.load.0.force=[0, 7, 0]", "object.bar.spin=[1, 2, 3]"});
    EXPECT_EQ(scene.objects[0].handles[0].release, 2.0);
    EXPECT_EQ(scene.objects[0].handles[0].keyframes[1].time, 5.0);
    EXPECT_EQ(std::get<ForceLoad>(scene.objects[0].loads[0].kind).sum, glm::dvec3(0.0, 7.0, 0.0));
    EXPECT_EQ(scene.objects[0].spin, glm::dvec3(1.0, 2.0, 3.0));
}

TEST_F(SceneFileDrives, RefusesWrongHandles) {
    EXPECT_EQ(handle_error("pivot = [0, 0, 0]"), "scene.toml:5: object.bar.handle[0]: needs \"region\"");
    EXPECT_EQ(handle_error("region = {plane = [1, 0, 0]}\nrelese = 2"),
              "scene.toml:7: object.bar.handle[0].relese = 2: unknown key (did you mean \"release\"?)");
    EXPECT_EQ(handle_error("region = {plane = [1, 0, 0]}\ndrag = {scale = 2}"),
              "scene.toml:7: object.bar.handle[0].drag.scale = 2: unknown key; known here are move and turn");
    EXPECT_EQ(handle_error("region = {plane = [1, 0, 0]}\nrelease = 0"),
              "scene.toml:7: object.bar.handle[0].release = 0: must be greater than 0");
    EXPECT_EQ(
        handle_error("region = {plane = [1, 0, 0]}\ninterpolation = 'smoth'"),
        "scene.toml:7: object.bar.handle[0].interpolation = \"smoth\": must be linear or smooth (did you "
        "mean \"smooth\"?)");
    EXPECT_EQ(handle_error("region = {cone = 1}"),
              "scene.toml:6: object.bar.handle[0].region: must have exactly one of box, sphere or plane");
    EXPECT_EQ(error(with("handle = 3", "")),
              "scene.toml:5: object.bar.handle = 3: must be a list of tables, is a whole number");
}

TEST_F(SceneFileDrives, RefusesWrongKeyframes) {
    EXPECT_EQ(
        handle_error("region = {plane = [1, 0, 0]}\nkeyframes = [{time = 0}]\nwhen_blocked = 'stop'"),
        "scene.toml:8: object.bar.handle[0].when_blocked = \"stop\": must be goes_on or stops (did you mean "
        "\"stops\"?)");
    const auto keyframes = [&](const std::string& list) {
        return handle_error("region = {plane = [1, 0, 0]}\nkeyframes = [" + list + "]");
    };
    EXPECT_EQ(keyframes("{turn = [1, 0, 0]}"),
              "scene.toml:7: object.bar.handle[0].keyframes[0]: needs \"time\"");
    EXPECT_EQ(keyframes("{time = 0}, {time = 0, turn = [1, 0, 0]}"),
              "scene.toml:7: object.bar.handle[0].keyframes[1].time = 0: must be greater than that of the "
              "keyframe before, 0");
    EXPECT_EQ(keyframes("{time = -1}"),
              "scene.toml:7: object.bar.handle[0].keyframes[0].time = -1: must be 0 or more");
    EXPECT_EQ(keyframes("{time = 0}, {time = 1, scale = 0}"),
              "scene.toml:7: object.bar.handle[0].keyframes[1].scale = 0: must be greater than 0");
    EXPECT_EQ(
        keyframes("{time = 0, move = [1, 0, 0]}"),
        "scene.toml:7: object.bar.handle[0].keyframes[0]: the first keyframe is where the body starts: it "
        "must not move, rotate or scale it");
    EXPECT_EQ(keyframes("{time = 0, turn = 90}"),
              "scene.toml:7: object.bar.handle[0].keyframes[0].turn = 90: must be a list of 3 numbers, is a "
              "whole number");
}

TEST_F(SceneFileDrives, RefusesWrongLoads) {
    EXPECT_EQ(load_error("region = {plane = [1, 0, 0]}"),
              "scene.toml:5: object.bar.load[0]: must have exactly one of force, traction or pressure");
    EXPECT_EQ(load_error("region = {plane = [1, 0, 0]}\nforce = [1, 0, 0]\npressure = 2"),
              "scene.toml:5: object.bar.load[0]: must have exactly one of force, traction or pressure, has "
              "force and pressure");
    EXPECT_EQ(load_error("region = {plane = [1, 0, 0]}\npressure = [1, 0, 0]"),
              "scene.toml:7: object.bar.load[0].pressure = [1, 0, 0]: must be a number, is a list");
    EXPECT_EQ(load_error("region = {plane = [1, 0, 0]}\nforce = [1, 0, 0]\nfrom = 2\nuntil = 1"),
              "scene.toml:9: object.bar.load[0].until = 1: must be greater than from, 2");
    EXPECT_EQ(load_error("region = {plane = [1, 0, 0]}\nforce = [1, 0, 0]\nfrom = -1"),
              "scene.toml:8: object.bar.load[0].from = -1: must be 0 or more");
}

// Two objects, and two colliders that have names; an attachment's own lines start on line 6.
class SceneFileAttachments : public SceneFile {
protected:
    static std::string with(const std::string& lines) {
        return "material = [{name = 'jelly'}]\n"
               "object = [{name = 'ball', shape = {sphere = 1}}, {name = 'beam', shape = {sphere = 1}}]\n"
               "collider = [{name = 'floor', shape = {plane = [0, 1, 0]}},\n"
               "            {name = 'post', shape = {sphere = 1}}]\n"
               "[[attachment]]\n" +
               lines + "\n";
    }
    std::string attachment_error(const std::string& lines, const Overrides& overrides = {}) {
        return error(with(lines), overrides);
    }
};

TEST_F(SceneFileAttachments, ReadsThem) {
    const Scene scene = load(with(R"(name = "hook"
object = "ball"
to = "beam"
region = { box = [[0, 1, 2], [3, 4, 5]] }
compliance = 1e-5
break_force = 100

[[attachment]]
object = "beam"
to = "post"
point = [1, 2, 3]

[[attachment]]
object = "beam"
line = [[0, 1, -1], [0, 1, 1.5]]

[[attachment]]
object = "ball"
to = "floor")"));
    ASSERT_EQ(scene.attachments.size(), 4u);
    const AttachmentDescription &hook = scene.attachments[0], &joint = scene.attachments[1],
                                &hinge = scene.attachments[2], &glue = scene.attachments[3];
    EXPECT_EQ(hook.name, "hook");
    EXPECT_EQ(hook.object, "ball");
    EXPECT_EQ(hook.to, "beam");
    const BoxRegion& box = std::get<BoxRegion>(std::get<Region>(hook.where));
    EXPECT_EQ(box.min, glm::dvec3(0.0, 1.0, 2.0));
    EXPECT_EQ(box.max, glm::dvec3(3.0, 4.0, 5.0));
    EXPECT_EQ(hook.compliance, 1e-5);
    EXPECT_EQ(hook.break_force, 100.0);
    EXPECT_EQ(hook.line, 5);
    EXPECT_EQ(joint.name, "");
    EXPECT_EQ(joint.to, "post");
    EXPECT_EQ(std::get<AttachedPoint>(joint.where).at, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(joint.compliance, 0.0);
    EXPECT_FALSE(joint.break_force);
    EXPECT_EQ(joint.line, 13);
    EXPECT_EQ(hinge.to, "");
    EXPECT_EQ(std::get<AttachedLine>(hinge.where).from, glm::dvec3(0.0, 1.0, -1.0));
    EXPECT_EQ(std::get<AttachedLine>(hinge.where).to, glm::dvec3(0.0, 1.0, 1.5));
    EXPECT_TRUE(std::holds_alternative<std::monostate>(glue.where));
}

TEST_F(SceneFileAttachments, CopiesAreAttachedByTheirOwnNames) {
    const std::string text =
        "material = [{name = 'jelly'}]\n[[object]]\nname = 'drop'\nshape = {sphere = 1}\n"
        "copies = {counts = [2, 1, 1], spacing = [3, 0, 0]}\n[[attachment]]\nobject = 'drop 1'\nto = ";
    EXPECT_EQ(load(text + "'drop 2'").attachments.at(0).to, "drop 2");
    EXPECT_EQ(error(text + "'drop'"),
              "scene.toml:8: attachment[0].to = \"drop\": must be another object's name or a collider's (did "
              "you mean \"drop 2\"?); there is drop 2");
}

TEST_F(SceneFileAttachments, CanBeOverridden) {
    const std::string text = with("name = 'hook'\nobject = 'ball'\nto = 'beam'");
    const Scene scene = load(
        text, {"attachment.hook.compliance=2e-3", "attachment.0.to=post", "attachment.hook.point=[0, 7, 0]"});
    EXPECT_EQ(scene.attachments.at(0).compliance, 2e-3);
    EXPECT_EQ(scene.attachments[0].to, "post");
    EXPECT_EQ(std::get<AttachedPoint>(scene.attachments[0].where).at, glm::dvec3(0.0, 7.0, 0.0));
    EXPECT_EQ(error(text, {"attachment.hook.break_force=-1"}),
              "--set attachment.hook.break_force=-1: attachment.hook.break_force = -1: must be greater than "
              "0");
}

TEST_F(SceneFileAttachments, RefusesWrongKeysAndTypes) {
    EXPECT_EQ(attachment_error("to = 'beam'"), "scene.toml:5: attachment[0]: needs \"object\"");
    EXPECT_EQ(attachment_error("name = 'hook'\nobjekt = 'ball'"),
              "scene.toml:7: attachment.hook.objekt = \"ball\": unknown key (did you mean \"object\"?)");
    EXPECT_EQ(attachment_error("object = 'ball'\npiont = [0, 0, 0]"),
              "scene.toml:7: attachment[0].piont = [0, 0, 0]: unknown key (did you mean \"point\"?)");
    EXPECT_EQ(
        attachment_error("object = 'ball'\nstrength = 3"),
        "scene.toml:7: attachment[0].strength = 3: unknown key; known here are name, object, to, region, "
        "point, line, rail, universal, distance, compliance, break_force, limits, spring and motor");
    EXPECT_EQ(attachment_error("object = 3"),
              "scene.toml:6: attachment[0].object = 3: must be a string, is a whole number");
    EXPECT_EQ(attachment_error("object = 'ball'\npoint = [0, 1]"),
              "scene.toml:7: attachment[0].point = [0, 1]: must be a list of 3 numbers, has 2");
    EXPECT_EQ(attachment_error("object = 'ball'\nregion = {cone = 1}"),
              "scene.toml:7: attachment[0].region: must have exactly one of box, sphere or plane");
    EXPECT_EQ(error(std::string(kBall) + "[attachment]\nobject = 'ball'"),
              "scene.toml:4: attachment: must be a list of tables: write [[attachment]]");
}

TEST_F(SceneFileAttachments, RefusesTwoOfRegionPointAndLine) {
    EXPECT_EQ(
        attachment_error("name = 'hook'\nobject = 'ball'\npoint = [0, 0, 0]\nline = [[0, 0, 0], [1, 0, 0]]"),
        "scene.toml:5: attachment.hook: must have at most one of region, point, line, rail, universal or "
        "distance, has point and line");
}

TEST_F(SceneFileAttachments, RefusesWhatIsNoLine) {
    const auto line_error = [&](const std::string& line) {
        return attachment_error("object = 'ball'\nline = " + line);
    };
    EXPECT_EQ(line_error("[0, 1, 0]"),
              "scene.toml:7: attachment[0].line = [0, 1, 0]: must be two points: [[x, y, z], [x, y, z]]");
    EXPECT_EQ(line_error("[[0, 1, 0]]"),
              "scene.toml:7: attachment[0].line = [[0, 1, 0]]: must be two points: [[x, y, z], [x, y, z]]");
    EXPECT_EQ(line_error("[[0, 1, 0], [1, 0]]"),
              "scene.toml:7: attachment[0].line = [[0, 1, 0], [1, 0]]: points must be three finite numbers "
              "each");
    EXPECT_EQ(line_error("[[0, 1, 0], [0, 'x', 0]]"),
              "scene.toml:7: attachment[0].line = [[0, 1, 0], [0, \"x\", 0]]: points must be three finite "
              "numbers each");
}

TEST_F(SceneFileAttachments, NamesTheLineOfAWrongValue) {
    EXPECT_EQ(attachment_error("object = 'bal'\nto = 'beam'"),
              "scene.toml:6: attachment[0].object = \"bal\": no such object (did you mean \"ball\"?); there "
              "is ball and beam");
    EXPECT_EQ(attachment_error("object = 'ball'\nto = 'flor'"),
              "scene.toml:7: attachment[0].to = \"flor\": must be another object's name or a collider's (did "
              "you mean \"floor\"?); there is beam, floor and post");
    EXPECT_EQ(attachment_error("object = 'ball'"),
              "scene.toml:5: attachment[0]: needs \"to\", or one of region, point, line, rail, universal and "
              "distance");
    EXPECT_EQ(attachment_error("object = 'ball'\nregion = {sphere = [0, 0, 0], radius = 0}"),
              "scene.toml:7: attachment[0].region.radius = 0: must be greater than 0");
    EXPECT_EQ(attachment_error("name = 'hook'\nobject = 'ball'\npoint = [0, nan, 0]"),
              "scene.toml:8: attachment.hook.point[1] = nan: must be finite");
    EXPECT_EQ(attachment_error("object = 'ball'\nline = [[0, 1, 0], [0, 1, 0]]"),
              "scene.toml:7: attachment[0].line = [[0, 1, 0], [0, 1, 0]]: must be two different points");
    EXPECT_EQ(attachment_error("object = 'ball'\nto = 'beam'\ncompliance = -1"),
              "scene.toml:8: attachment[0].compliance = -1: must be 0 or more");
    EXPECT_EQ(attachment_error("name = 'a'\nobject = 'ball'\nto = 'beam'\n[[attachment]]\nname = 'a'\n"
                               "object = 'beam'\nto = 'floor'"),
              "scene.toml:10: attachment.a.name = \"a\": is taken by the attachment on line 5");
    EXPECT_EQ(attachment_error("object = 'ball'\nto = 'beam'\n[simulation]\nsolver = 'rk4'"),
              "scene.toml:5: attachment[0]: needs simulation.solver = \"implicit\"");
}

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
