#include <glm/common.hpp>
#include <set>

#include "model/assembly/build_model.h"
#include "model/scene/scene_file_fixture.h"

namespace gelatin::test {
namespace {

class SceneFileCopies : public SceneFile {
protected:
    // The scene's only object, on lines 2 to 6; its copies table is on line 6.
    static std::string with_copies(const std::string& table, const std::string& name = "ball") {
        return "material = [{name = 'jelly'}]\n[[object]]\nname = '" + name +
               "'\nshape = {box = [1, 1, 1]}\nposition = [1, 2, 3]\ncopies = " + table + "\n";
    }
};

TEST_F(SceneFileCopies, StandInABlockAroundThePosition) {
    const Scene scene = load(with_copies("{counts = [3, 2, 1], spacing = [2, 1, 0]}"));
    ASSERT_EQ(scene.objects.size(), 6u);
    EXPECT_EQ(scene.objects[0].name, "ball 1");
    EXPECT_EQ(scene.objects[5].name, "ball 6");
    EXPECT_EQ(scene.objects[0].position, glm::dvec3(-1.0, 1.5, 3.0));
    EXPECT_EQ(scene.objects[1].position, glm::dvec3(1.0, 1.5, 3.0));
    EXPECT_EQ(scene.objects[5].position, glm::dvec3(3.0, 2.5, 3.0));
    for (const ObjectDescription& object : scene.objects) {
        EXPECT_EQ(object.rotation, glm::dvec3(0.0));
        EXPECT_EQ(object.material, "jelly");
        EXPECT_EQ(object.line, 2);
        EXPECT_FALSE(object.color) << "each has the palette's next colour";
    }
}

TEST_F(SceneFileCopies, JitterStaysInItsBoundsAndIsTheSameEachTime) {
    const std::string text =
        with_copies("{counts = [5, 5, 5], spacing = [1, 1, 1], jitter = 0.25, turn = 30}");
    const Scene scene = load(text), again = load(text);
    glm::dvec3 low(1.0), high(-1.0);
    std::set<double> turns;
    for (std::size_t i = 0; i < 125; ++i) {
        const glm::dvec3 place(i % 5, i / 25, i / 5 % 5);
        const glm::dvec3 moved = scene.objects[i].position - (glm::dvec3(-1.0, 0.0, 1.0) + place);
        low = glm::min(low, moved);
        high = glm::max(high, moved);
        turns.insert(scene.objects[i].rotation.x);
        EXPECT_LE(std::abs(scene.objects[i].rotation.y), 30.0);
        EXPECT_EQ(scene.objects[i].position, again.objects[i].position);
        EXPECT_EQ(scene.objects[i].rotation, again.objects[i].rotation);
    }
    EXPECT_EQ(turns.size(), 125u);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(low[axis], -0.25);
        EXPECT_LT(low[axis], -0.2) << "of 125 numbers one is near the end";
        EXPECT_LE(high[axis], 0.25);
        EXPECT_GT(high[axis], 0.2);
    }
    // The same on every machine: std::mt19937's first number is 3499211612.
    EXPECT_DOUBLE_EQ(scene.objects[0].position.x, -1.0 + 0.25 * (3499211612.0 / 2147483648.0 - 1.0));
}

TEST_F(SceneFileCopies, AreRefusedWithTheirLine) {
    EXPECT_EQ(error(with_copies("{counts = [2, 1, 1], spacng = [1, 1, 1]}")),
              "scene.toml:6: object.ball.copies.spacng = [1, 1, 1]: unknown key (did you mean \"spacing\"?)");
    EXPECT_EQ(error(with_copies("{counts = [2, 1, 1]}")),
              "scene.toml:6: object.ball.copies: needs \"spacing\"");
    EXPECT_EQ(error(with_copies("{counts = [2, 0, 1], spacing = [1, 1, 1]}")),
              "scene.toml:6: object.ball.copies.counts[1] = 0: must be from 1 to 100000");
    EXPECT_EQ(
        error(with_copies("{counts = [100, 100, 11], spacing = [1, 1, 1]}")),
        "scene.toml:6: object.ball.copies.counts = [100, 100, 11]: must make at most 100000 copies, make "
        "110000");
    EXPECT_EQ(error(with_copies("{counts = [100000, 100000, 100000], spacing = [1, 1, 1]}")),
              "scene.toml:6: object.ball.copies.counts = [100000, 100000, 100000]: must make at most 100000 "
              "copies, make 1000000000000000");
    EXPECT_EQ(error(with_copies("{counts = [1, 2, 1], spacing = [1, 0, 1]}")),
              "scene.toml:6: object.ball.copies.spacing = [1, 0, 1]: must be greater than 0 along y");
    EXPECT_EQ(error(with_copies("{counts = [2, 1, 1], spacing = [1, 1, 1], turn = 200}")),
              "scene.toml:6: object.ball.copies.turn = 200: must be from 0 to 180");
    EXPECT_EQ(error(with_copies("[2, 1, 1]")),
              "scene.toml:6: object.ball.copies = [2, 1, 1]: must be a table, is a list");
}

TEST_F(SceneFileCopies, NamesMustBeFree) {
    EXPECT_EQ(error(with_copies("{counts = [2, 1, 1], spacing = [1, 1, 1]}") +
                    "[[object]]\nname = 'ball 2'\nshape = {sphere = 1}"),
              "scene.toml:8: object.ball 2.name = \"ball 2\": is taken by the object on line 2");
    EXPECT_EQ(error("material = [{name = 'a'}]\n[[object]]\nname = 'b 1'\nshape = {sphere = 1}\n[[object]]\n"
                    "name = 'b'\nshape = {sphere = 1}\ncopies = {counts = [1, 1, 1], spacing = [1, 1, 1]}"),
              "scene.toml:6: object.b.name = \"b\": \"b 1\" is taken by the object on line 2");
}

TEST_F(SceneFileCopies, CanBeOverridden) {
    const Scene scene = load(with_copies("{counts = [9, 9, 9], spacing = [1, 1, 1]}"),
                             {"object.ball.copies.counts=[2, 1, 1]"});
    EXPECT_EQ(scene.objects.size(), 2u);
}

// Each is a body of its own, of the same tets.
TEST_F(SceneFileCopies, BecomeBodies) {
    const Model model =
        build_model(load(with_copies("{counts = [2, 1, 2], spacing = [3, 1, 4], jitter = 0.1, turn = 40}")));
    ASSERT_EQ(model.objects.size(), 4u);
    for (const ModelObject& object : model.objects) {
        EXPECT_EQ(object.nodes.count, model.objects[0].nodes.count);
        EXPECT_EQ(object.tets.count, model.objects[0].tets.count);
        EXPECT_NEAR(object.rest_volume, 1.0, 1e-9);
    }
    EXPECT_EQ(model.objects[3].name, "ball 4");
    glm::vec3 center(0.0f);
    for (std::uint32_t n = model.objects[3].nodes.first; n < model.objects[3].nodes.end(); ++n)
        center += glm::vec3(model.positions[n]) / static_cast<float>(model.objects[3].nodes.count);
    EXPECT_NEAR(center.x, 2.5f, 0.2f);
    EXPECT_NEAR(center.z, 5.0f, 0.2f);
}

}  // namespace
}  // namespace gelatin::test
