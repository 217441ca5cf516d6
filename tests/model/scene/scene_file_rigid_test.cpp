#include "model/scene/override_scene.h"
#include "model/scene/scene_file_fixture.h"

namespace gelatin::test {
namespace {

// Both kinds of objects in turn; each of the tables of one kind has another place in the scene than in the
// file's list of that kind.
constexpr const char* kMixed = R"([[material]]
name = "jelly"

[[rigid]]
name = "a"
shape = { sphere = 1 }

[[object]]
name = "b"
shape = { sphere = 1 }
copies = { counts = [2, 1, 1], spacing = [3, 0, 0] }

[[rigid]]
name = "c"
shape = { box = [1, 2, 3] }
copies = { counts = [1, 2, 1], spacing = [0, 3, 0] }

[[rigid]]
name = "d"
shape = { sphere = 1 }

[[object]]
name = "e"
shape = { sphere = 1 }
)";

class SceneFileRigid : public SceneFile {
protected:
    // Of a rigid body whose lines after its name are these: line 4 and on.
    std::string rigid_error(const std::string& lines) {
        return error("material = [{name = 'jelly'}]\n[[rigid]]\nname = 'crate'\n" + lines + "\n");
    }

    static std::vector<std::string> names_of(const Scene& scene) {
        std::vector<std::string> names;
        for (const ObjectDescription& object : scene.objects)
            names.push_back((object.rigid ? "rigid " : "") + object.name);
        return names;
    }
};

TEST_F(SceneFileRigid, ReadsEveryKey) {
    const Scene scene = load(R"([[material]]
name = "wood"
[[material]]
name = "foam"
[[rigid]]
name = "crate"
shape = { box = [1, 2, 3] }
material = "wood"
position = [1, 2, 3]
rotation = [4, 5, 6]
up = "z"
scale = 2
velocity = [7, 8, 9]
spin = [10, 11, 12]
color = [0.1, 0.2, 0.3]
mass = 20
inertia = [1, 2, 2.5]
[[rigid.load]]
region = { sphere = [0, 0, 0], radius = 1 }
force = [1, 0, 0]
)");
    const ObjectDescription& crate = scene.objects.at(0);
    EXPECT_EQ(crate.name, "crate");
    EXPECT_EQ(std::get<BoxShape>(crate.shape).size, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(crate.material, "wood");
    EXPECT_EQ(crate.position, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(crate.rotation, glm::dvec3(4.0, 5.0, 6.0));
    EXPECT_EQ(crate.up, Axis::z);
    EXPECT_EQ(crate.scale, 2.0);
    EXPECT_EQ(crate.velocity, glm::dvec3(7.0, 8.0, 9.0));
    EXPECT_EQ(crate.spin, glm::dvec3(10.0, 11.0, 12.0));
    EXPECT_EQ(crate.color, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(crate.line, 5);
    ASSERT_EQ(crate.loads.size(), 1u);
    EXPECT_EQ(crate.loads[0].line, 18);
    ASSERT_TRUE(crate.rigid);
    EXPECT_EQ(crate.rigid->mass, 20.0);
    EXPECT_EQ(crate.rigid->inertia, glm::dvec3(1.0, 2.0, 2.5));
}

TEST_F(SceneFileRigid, HasTheOnlyMaterialAndItsDensity) {
    const Scene scene = load("material = [{name = 'wood'}]\nrigid = [{name = 'a', shape = {sphere = 1}}]\n");
    EXPECT_EQ(scene.objects.at(0).material, "wood");
    ASSERT_TRUE(scene.objects[0].rigid);
    EXPECT_FALSE(scene.objects[0].rigid->mass);
    EXPECT_FALSE(scene.objects[0].rigid->inertia);
}

TEST_F(SceneFileRigid, ObjectsAreInTheOrderOfTheFile) {
    EXPECT_THAT(names_of(load(kMixed)),
                testing::ElementsAre("rigid a", "b 1", "b 2", "rigid c 1", "rigid c 2", "rigid d", "e"));
    EXPECT_THAT(
        names_of(load("material = [{name = 'm'}]\n"
                      "rigid = [{name = 'a', shape = {sphere = 1}}, {name = 'b', shape = {sphere = 1}}]\n"
                      "object = [{name = 'c', shape = {sphere = 1}}, {name = 'd', shape = {sphere = 1}}]")),
        testing::ElementsAre("rigid a", "rigid b", "c", "d"));
}

// Of what is found to be wrong only after all tables have been read.
TEST_F(SceneFileRigid, ErrorsHaveTheLineOfTheirTable) {
    const auto with = [](const std::string& name, const std::string& line) {
        std::string text = kMixed;
        return text.insert(text.find("name = \"" + name + "\""), line + "\n");
    };
    EXPECT_EQ(error(with("a", "scale = 0")), "scene.toml:5: rigid.a.scale = 0: must be greater than 0");
    EXPECT_EQ(error(with("b", "scale = 0")), "scene.toml:9: object.b.scale = 0: must be greater than 0");
    EXPECT_EQ(error(with("c", "mass = 0")), "scene.toml:14: rigid.c.mass = 0: must be greater than 0");
    EXPECT_EQ(error(with("d", "inertia = [1, 1, 3]")),
              "scene.toml:19: rigid.d.inertia[2] = 3: must be at most the sum of the other two, 2");
    EXPECT_EQ(error(with("e", "scale = 0")), "scene.toml:23: object.e.scale = 0: must be greater than 0");
    EXPECT_EQ(error(std::string(kMixed) + "[simulation]\nsolver = 'midpoint'"),
              "scene.toml:4: rigid.a: needs simulation.solver = \"implicit\"");
    EXPECT_EQ(error(std::string(kMixed) + "[[rigid]]\nname = 'e'\nshape = {sphere = 1}"),
              "scene.toml:26: rigid.e.name = \"e\": is taken by the object on line 22");
}

TEST_F(SceneFileRigid, RefusesWhatItCannotRead) {
    EXPECT_EQ(error("rigid = 3"), "scene.toml:1: rigid = 3: must be a list of tables, is a whole number");
    EXPECT_EQ(rigid_error("mass = 3"), "scene.toml:2: rigid[0]: needs \"shape\"");
    EXPECT_EQ(rigid_error("shape = {sphere = 1}\nmass = 'much'"),
              "scene.toml:5: rigid.crate.mass = \"much\": must be a number, is a string");
    EXPECT_EQ(rigid_error("shape = {sphere = 1}\ninertia = 3"),
              "scene.toml:5: rigid.crate.inertia = 3: must be a list of 3 numbers, is a whole number");
    EXPECT_EQ(rigid_error("shape = {sphere = 1}\ninerta = [1, 1, 1]"),
              "scene.toml:5: rigid.crate.inerta = [1, 1, 1]: unknown key (did you mean \"inertia\"?)");
    EXPECT_EQ(rigid_error("shape = {sphere = 1}\nwobbliness = 3"),
              "scene.toml:5: rigid.crate.wobbliness = 3: unknown key; known here are name, shape, material, "
              "position, rotation, up, scale, velocity, spin, load, color, mass, inertia and copies");
    EXPECT_THAT(object_error("shape = {sphere = 1}\nmass = 3"),
                testing::HasSubstr("scene.toml:5: object.ball.mass = 3: unknown key; known here are name, "));
}

TEST_F(SceneFileRigid, RefusesWhatOnlyDeformableObjectsHave) {
    const std::string nodes =
        ": a rigid body has none: an [[attachment]] holds it, and a [[collider]] follows keyframes";
    const std::string tets = ": a rigid body has none: it does not deform, and has no tets";
    const auto error_of = [&](const std::string& line) {
        return rigid_error("shape = {sphere = 1}\n" + line);
    };
    EXPECT_EQ(error_of("pins = [{plane = [0, 1, 0]}]"), "scene.toml:5: rigid.crate.pins = [{...}]" + nodes);
    EXPECT_EQ(error_of("[[rigid.handle]]\nregion = {plane = [0, 1, 0]}"),
              "scene.toml:5: rigid.crate.handle = [{...}]" + nodes);
    EXPECT_EQ(error_of("mesher = {nodes = 100}"), "scene.toml:5: rigid.crate.mesher" + tets);
    EXPECT_EQ(error_of("[[rigid.part]]\nmaterial = 'jelly'"),
              "scene.toml:5: rigid.crate.part = [{...}]" + tets);
    EXPECT_EQ(error_of("start = {scatter = 1}"), "scene.toml:5: rigid.crate.start" + tets);
    EXPECT_EQ(error_of("skin = true"), "scene.toml:5: rigid.crate.skin = true" + tets);
}

TEST_F(SceneFileRigid, CanBeOverridden) {
    const Scene scene =
        load(kMixed, {"rigid.d.mass=2", "rigid.0.inertia=[1, 1, 1]", "rigid.c.copies.counts=[1, 1, 1]",
                      "object.1.scale=3", "rigid.a.velocity=[0, 1, 0]"});
    ASSERT_THAT(names_of(scene), testing::ElementsAre("rigid a", "b 1", "b 2", "rigid c 1", "rigid d", "e"));
    EXPECT_EQ(scene.objects[0].rigid->inertia, glm::dvec3(1.0));
    EXPECT_EQ(scene.objects[0].velocity, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(scene.objects[4].rigid->mass, 2.0);
    EXPECT_EQ(scene.objects[5].scale, 3.0);
    EXPECT_EQ(error(kMixed, {"rigid.d.mass=-1"}),
              "--set rigid.d.mass=-1: rigid.d.mass = -1: must be greater than 0");
    EXPECT_EQ(error(kMixed, {"rigid.b.mass=1"}),
              "--set rigid.b.mass=1: no rigid is called \"b\"; there are 3, numbered from 0");
}

TEST_F(SceneFileRigid, ScenesOfProgramsCanBeOverridden) {
    const Scene scene = override_scene(load(kMixed), {"rigid.d.mass=2"});
    EXPECT_EQ(names_of(scene), names_of(load(kMixed)));
    EXPECT_EQ(scene.objects.at(5).rigid->mass, 2.0);
}

}  // namespace
}  // namespace gelatin::test
