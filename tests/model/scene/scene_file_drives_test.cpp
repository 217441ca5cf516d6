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

}  // namespace
}  // namespace gelatin::test
