#include "model/scene/scene_file_fixture.h"

namespace gelatin::test {
namespace {

class SceneFileBodies : public SceneFile {};

TEST_F(SceneFileBodies, ReadsEveryShape) {
    const Scene scene = load(R"(
material = [{ name = "jelly" }]
object = [
    { name = "a", shape = { box = [1, 2, 3], segments = [4, 5, 6] } },
    { name = "b", shape = { capsule = 0.1, length = 0.7, frequency = 4 } },
    { name = "c", shape = { text = "A", depth = 0.3, size = 2, font = "DejaVu Serif" } },
    { name = "d", shape = { file = "bunny.obj" } },
]
collider = [{ shape = { box = [1, 2, 3] } }, { shape = { sphere = 4 } }]
)");
    ASSERT_EQ(scene.objects.size(), 4u);
    EXPECT_EQ(std::get<BoxShape>(scene.objects[0].shape).size, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(std::get<BoxShape>(scene.objects[0].shape).segments, glm::ivec3(4, 5, 6));
    EXPECT_EQ(std::get<CapsuleShape>(scene.objects[1].shape).radius, 0.1);
    EXPECT_EQ(std::get<CapsuleShape>(scene.objects[1].shape).length, 0.7);
    EXPECT_EQ(std::get<CapsuleShape>(scene.objects[1].shape).frequency, 4);
    EXPECT_EQ(std::get<TextShape>(scene.objects[2].shape).text, "A");
    EXPECT_EQ(std::get<TextShape>(scene.objects[2].shape).depth, 0.3);
    EXPECT_EQ(std::get<TextShape>(scene.objects[2].shape).size, 2.0);
    EXPECT_EQ(std::get<TextShape>(scene.objects[2].shape).font, "DejaVu Serif");
    EXPECT_EQ(std::get<FileShape>(scene.objects[3].shape).file, scene.file.parent_path() / "bunny.obj");
    EXPECT_EQ(std::get<BoxShape>(std::get<Shape>(scene.colliders.at(0).shape)).size,
              glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(std::get<SphereShape>(std::get<Shape>(scene.colliders.at(1).shape)).radius, 4.0);
}

TEST_F(SceneFileBodies, ReadsHowAnObjectStarts) {
    const Scene scene = load(R"(
material = [{ name = "jelly" }]
object = [
    { name = "a", shape = { sphere = 1 } },
    { name = "b", shape = { sphere = 1 }, start = { scale = [1, 0, 0.5], scatter = 0.1 } },
]
)");
    EXPECT_EQ(scene.objects.at(0).start.scale, glm::dvec3(1.0));
    EXPECT_EQ(scene.objects.at(0).start.scatter, 0.0);
    EXPECT_EQ(scene.objects.at(1).start.scale, glm::dvec3(1.0, 0.0, 0.5));
    EXPECT_EQ(scene.objects.at(1).start.scatter, 0.1);
    EXPECT_EQ(object_error("shape = {sphere = 1}\nstart = {scatter = -1}"),
              "scene.toml:5: object.ball.start.scatter = -1: must be 0 or more");
}

TEST_F(SceneFileBodies, ReadsWhetherItsOwnSurfaceIsDrawn) {
    const Scene scene = load(R"(
material = [{ name = "jelly" }]
object = [
    { name = "a", shape = { sphere = 1 } },
    { name = "b", shape = { sphere = 1 }, skin = false },
]
)");
    EXPECT_TRUE(scene.objects.at(0).skin);
    EXPECT_FALSE(scene.objects.at(1).skin);
    EXPECT_THAT(object_error("shape = {sphere = 1}\nskin = 1"), testing::HasSubstr("object.ball.skin"));
}

// Parts

TEST_F(SceneFileBodies, ReadsParts) {
    const Scene scene = load(R"(
material = [{ name = "jelly" }, { name = "bone" }]
[[object]]
name = "arm"
shape = { file = "arm.mesh" }
material = "jelly"
[[object.part]]
region = { box = [[0, 0, 0], [1, 2, 3]] }
material = "bone"
[[object.part]]
attribute = -2
material = "jelly"
[[object]]
name = "ball"
shape = { sphere = 1 }
material = "bone"
)");
    const auto& parts = scene.objects[0].parts;
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(std::get<BoxRegion>(std::get<Region>(parts[0].where)).max, glm::dvec3(1, 2, 3));
    EXPECT_EQ(parts[0].material, "bone");
    EXPECT_EQ(parts[0].line, 7);
    EXPECT_EQ(std::get<TetAttribute>(parts[1].where).number, -2);
    EXPECT_TRUE(scene.objects[1].parts.empty());
}

TEST_F(SceneFileBodies, RefusesPartsThatAreNotSaidRightly) {
    const auto part_error = [&](const std::string& lines) {
        return object_error("shape = {sphere = 1}\n[[object.part]]\n" + lines);
    };
    EXPECT_EQ(part_error("region = {sphere = [0, 0, 0], radius = 1}"),
              "scene.toml:5: object.ball.part[0]: needs \"material\"");
    EXPECT_THAT(part_error("material = 'jelly'"), testing::HasSubstr("scene.toml:5: object.ball.part[0]: "));
    EXPECT_THAT(part_error("material = 'jelly'\nattribute = 1\nregion = {plane = [0, 1, 0]}"),
                testing::HasSubstr("scene.toml:5: object.ball.part[0]: "));
    EXPECT_EQ(part_error("material = 'bone'\nattribute = 1"),
              "scene.toml:6: object.ball.part[0].material = \"bone\": no such material; there is jelly");
    EXPECT_EQ(part_error("material = 'jelly'\nattribute = 1.5"),
              "scene.toml:7: object.ball.part[0].attribute = 1.5: must be a whole number, is a fraction");
    EXPECT_EQ(part_error("material = 'jelly'\nattribute = 1\nstiff = true"),
              "scene.toml:8: object.ball.part[0].stiff = true: unknown key; known here are material and "
              "attribute");
}

// Names

TEST_F(SceneFileBodies, RefusesNamesThatAreTaken) {
    EXPECT_EQ(error("[[material]]\nname = 'jelly'\n[[material]]\nname = 'jelly'"),
              "scene.toml:4: material.jelly.name = \"jelly\": is taken by the material on line 1");
    EXPECT_EQ(object_error("shape = {sphere = 1}\n[[object]]\nname = 'ball'\nshape = {sphere = 2}"),
              "scene.toml:6: object.ball.name = \"ball\": is taken by the object on line 2");
}

TEST_F(SceneFileBodies, RefusesAnEmptyName) {
    EXPECT_EQ(error("[[material]]\nname = ''"), "scene.toml:2: material[0].name = \"\": must not be empty");
}

TEST_F(SceneFileBodies, RefusesANameOfTwoLines) {
    EXPECT_EQ(
        error("[[material]]\nname = \"a\\nb\""),
        "scene.toml:2: material[0].name = \"a\\nb\": must not have line breaks or other control characters");
}

TEST_F(SceneFileBodies, RefusesAnUnknownMaterial) {
    EXPECT_EQ(object_error("shape = {sphere = 1}\nmaterial = 'jely'"),
              "scene.toml:5: object.ball.material = \"jely\": no such material (did you mean \"jelly\"?); "
              "there is jelly");
    EXPECT_EQ(error("[[object]]\nname = 'ball'\nshape = {sphere = 1}\nmaterial = 'steel'"),
              "scene.toml:4: object.ball.material = \"steel\": no such material; the scene has none");
}

TEST_F(SceneFileBodies, RefusesAnObjectWithoutMaterialUnlessThereIsOne) {
    EXPECT_EQ(error("[[object]]\nname = 'ball'\nshape = {sphere = 1}"),
              "scene.toml:1: object.ball: needs a material: the scene has no [[material]]");
    EXPECT_EQ(
        error("material = [{name = 'a'}, {name = 'b'}]\n[[object]]\nname = 'ball'\nshape = {sphere = 1}"),
        "scene.toml:2: object.ball: needs \"material\": one of a or b");
}

// Shapes, pins, colliders

TEST_F(SceneFileBodies, RefusesShapesOfNoneOrTwoKinds) {
    EXPECT_EQ(object_error("shape = {frequency = 4}"),
              "scene.toml:4: object.ball.shape: must have exactly one of sphere, box, capsule, text or file");
    EXPECT_EQ(object_error("shape = {sphere = 1, box = [1, 1, 1]}"),
              "scene.toml:4: object.ball.shape: must have exactly one of sphere, box, capsule, text or "
              "file, has sphere "
              "and box");
    EXPECT_EQ(object_error("shape = {spere = 1}"),
              "scene.toml:4: object.ball.shape.spere = 1: unknown key (did you mean \"sphere\"?)");
    EXPECT_EQ(object_error("shape = 'sphere'"),
              "scene.toml:4: object.ball.shape = \"sphere\": must be a table, is a string");
}

TEST_F(SceneFileBodies, RefusesWrongShapeValues) {
    EXPECT_EQ(object_error("shape = {sphere = -1}"),
              "scene.toml:4: object.ball.shape.sphere = -1: must be greater than 0");
    EXPECT_EQ(object_error("shape = {sphere = 1, frequency = 1000000}"),
              "scene.toml:4: object.ball.shape.frequency = 1000000: must be from 1 to 500");
    EXPECT_EQ(object_error("shape = {sphere = 1, segments = [1, 1, 1]}"),
              "scene.toml:4: object.ball.shape.segments = [1, 1, 1]: unknown key; known here are sphere and "
              "frequency");
    EXPECT_EQ(object_error("shape = {box = [1, 0, 1]}"),
              "scene.toml:4: object.ball.shape.box[1] = 0: must be greater than 0");
    EXPECT_EQ(object_error("shape = {box = [1, 1, 1], segments = [1, 1, 0]}"),
              "scene.toml:4: object.ball.shape.segments[2] = 0: must be from 1 to 1000");
    EXPECT_EQ(object_error("shape = {capsule = 1, frequency = 1}"),
              "scene.toml:4: object.ball.shape.frequency = 1: must be from 2 to 500");
    EXPECT_EQ(object_error("shape = {text = ''}"),
              "scene.toml:4: object.ball.shape.text = \"\": must not be empty");
    EXPECT_EQ(object_error("shape = {text = 'A', depth = 0}"),
              "scene.toml:4: object.ball.shape.depth = 0: must be greater than 0");
}

TEST_F(SceneFileBodies, RefusesWrongPins) {
    const auto pin = [&](const std::string& value) {
        return object_error("shape = {sphere = 1}\npins = [" + value + "]");
    };
    EXPECT_EQ(pin("{box = [[0, 0, 0], [1, -1, 1]]}"),
              "scene.toml:5: object.ball.pins[0].box = [[0, 0, 0], [1, -1, 1]]: the first corner must be the "
              "lower one: "
              "0 is above -1 along y");
    EXPECT_EQ(
        pin("{box = [1, 1, 1]}"),
        "scene.toml:5: object.ball.pins[0].box = [1, 1, 1]: must be two corners: [[x, y, z], [x, y, z]]");
    EXPECT_EQ(pin("{box = [[0, 0, 0], [1, inf, 1]]}"),
              "scene.toml:5: object.ball.pins[0].box = [[0, 0, 0], [1, inf, 1]]: corners must be three "
              "finite numbers "
              "each");
    EXPECT_EQ(pin("{sphere = [0, 0, 0]}"), "scene.toml:5: object.ball.pins[0]: needs \"radius\"");
    EXPECT_EQ(pin("{plane = [0, 0, 0]}"),
              "scene.toml:5: object.ball.pins[0].plane = [0, 0, 0]: must not be zero: a direction");
    EXPECT_EQ(pin("{}"), "scene.toml:5: object.ball.pins[0]: must have exactly one of box, sphere or plane");
}

TEST_F(SceneFileBodies, RefusesWrongColliders) {
    const auto collider = [&](const std::string& lines) {
        return error(std::string(kBall) + "[[collider]]\n" + lines);
    };
    EXPECT_EQ(collider("shape = {plane = [0, 0, 0]}"),
              "scene.toml:5: collider[0].shape.plane = [0, 0, 0]: must not be zero: a direction");
    EXPECT_EQ(collider("shape = {plane = [0, 1, 0]}\nposition = [0, 1, 0]"),
              "scene.toml:6: collider[0].position = [0, 1, 0]: a plane has none: its shape's normal and "
              "offset place it");
    EXPECT_EQ(
        collider("shape = {cube = 1}"),
        "scene.toml:5: collider[0].shape: must have exactly one of plane, box, sphere, capsule, text or "
        "file");
    EXPECT_EQ(collider("shape = {sphere = 1}\nrestitution = 2"),
              "scene.toml:6: collider[0].restitution = 2: must be from 0 to 1");
    EXPECT_EQ(collider("friction = 1"), "scene.toml:4: collider[0]: needs \"shape\"");
    const std::string wall = "name = 'wall'\nshape = {plane = [0, 1, 0]}\n";
    EXPECT_EQ(collider(wall + "[[collider]]\n" + wall),
              "scene.toml:8: collider.wall.name = \"wall\": is taken by the collider on line 4");
}

// Those who need no name have none, or a real one.
TEST_F(SceneFileBodies, RefusesEmptyNames) {
    const std::string ball(kBall);
    EXPECT_EQ(error(ball + "[[collider]]\nname = ''\nshape = {plane = [0, 1, 0]}"),
              "scene.toml:5: collider[0].name = \"\": must not be empty");
    EXPECT_EQ(error(ball + "[[attachment]]\nname = ''\nobject = 'ball'\npoint = [0, 0, 0]"),
              "scene.toml:5: attachment[0].name = \"\": must not be empty");
    EXPECT_EQ(object_error("shape = {sphere = 1}\ncavity = [{name = ''}]"),
              "scene.toml:5: object.ball.cavity[0].name = \"\": must not be empty");
}

}  // namespace
}  // namespace gelatin::test
