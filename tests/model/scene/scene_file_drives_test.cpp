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
    EXPECT_EQ(handle_error("pivot = [0, 0, 0]"),
              "scene.toml:5: object.bar.handle[0]: must have exactly one of region or skeleton");
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

}  // namespace
}  // namespace gelatin::test
