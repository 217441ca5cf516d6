// Clips of glTF files: skins, morph targets, nodes, and how values lie between keys.
#include <glm/gtc/constants.hpp>

#include "mesh/surface_file_fixture.h"
#include "mesh/surface_readers.h"
#include "support/gltf_maker.h"

namespace gelatin {
namespace {

using testing::HasSubstr;
using Json = test::GltfMaker::Json;

class GltfMotionTest : public SurfaceFileFixture {
protected:
    SkinnedVertices vertices_of(const test::GltfMaker& maker, const std::string& clip = "") {
        return read_gltf_vertices(make("a.glb", maker.content()), clip);
    }
    std::string refusal_of(const std::function<void(Json&)>& change) {
        test::GltfMaker maker = test::bending_bar();
        change(maker.json);
        return refusal([&] { vertices_of(maker); });
    }
};

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected, double within = 1e-6) {
    EXPECT_LT(glm::distance(actual, expected), within)
        << actual.x << ' ' << actual.y << ' ' << actual.z << ", not " << expected.x << ' ' << expected.y
        << ' ' << expected.z;
}

// A triangle that a node moves, with one clip of one track.
test::GltfMaker moved_triangle(const char* path, const std::vector<float>& times,
                               const std::vector<float>& values, const char* type,
                               const char* interpolation) {
    test::GltfMaker maker;
    maker.json["meshes"] = {
        {{"primitives",
          {{{"attributes", {{"POSITION", maker.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3")}}},
            {"targets",
             {{{"POSITION", maker.add(std::vector<float>{0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3")}},
              {{"POSITION", maker.add(std::vector<float>{4, 0, 0, 4, 0, 0, 4, 0, 0}, "VEC3")}}}}}}},
         {"weights", {0.0, 0.25}}}};
    maker.json["nodes"] = {{{"mesh", 0}, {"translation", {10, 0, 0}}}};
    maker.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
                                 {"samplers",
                                  {{{"input", maker.add(times, "SCALAR")},
                                    {"output", maker.add(values, type)},
                                    {"interpolation", interpolation}}}}}};
    return maker;
}

TEST_F(GltfMotionTest, JointsMoveTheVerticesOfASkin) {
    const SkinnedVertices bar = vertices_of(test::bending_bar(), "bend");
    ASSERT_EQ(bar.points.size(), 36u);
    EXPECT_DOUBLE_EQ(bar.clip.duration(), 1.0);
    const std::vector<glm::dvec3> half = place_vertices(bar, 0.5, 1.0), end = place_vertices(bar, 1.0, 1.0);
    expect_near(end[0], {-0.1, 0.0, -0.1});
    expect_near(end[32], {-1.0, 0.9, -0.1});  // (-0.1, 2, -0.1), about (0, 1, 0)
    const double r = std::sqrt(0.5);
    expect_near(half[32], {-1.1 * r, 1.0 + 0.9 * r, -0.1});
    expect_near(end[16], 0.5 * (glm::dvec3(-0.1, 1.0, -0.1) + glm::dvec3(0.0, 0.9, -0.1)));
    EXPECT_EQ(place_vertices(bar, 2.0, 1.0), end) << "it stays where it ends";
}

TEST_F(GltfMotionTest, FilesWithoutAClipAreAsTheirOwnPoseHasThem) {
    test::GltfMaker maker = test::bending_bar();
    const SurfaceMesh straight = read("a.glb", maker.content());
    for (const glm::dvec3& p : straight.positions)
        EXPECT_LE(std::abs(p.x), 0.1000001) << "the node of the mesh";
    EXPECT_NEAR(signed_volume(straight), 0.08, 1e-6);
    EXPECT_THAT(notes_, testing::IsEmpty());
    maker.json["nodes"][2]["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
    double least = 0.0;
    for (const glm::dvec3& p : read("a.glb", maker.content()).positions) least = std::min(least, p.x);
    EXPECT_NEAR(least, -1.0, 1e-6);
}

TEST_F(GltfMotionTest, ClipsAreReachedFromTheFilesOwnPose) {
    test::GltfMaker maker = test::bending_bar();
    maker.json["nodes"][2]["rotation"] = {0, 0, -std::sqrt(0.5), std::sqrt(0.5)};
    VertexMotion motion{vertices_of(maker), 2.0};
    expect_near(motion.at(0.0)[32], {1.0, 1.1, -0.1});
    const double r = std::sqrt(0.5);  // half of the way from -90 degrees to 0
    expect_near(motion.at(1.0)[32], {r * 1.0 - r * 0.1, 1.0 + r * 1.0 + r * 0.1, -0.1});
    expect_near(motion.at(2.0)[32], {-0.1, 2.0, -0.1});
    expect_near(motion.at(3.0)[32], {-1.0, 0.9, -0.1});
    EXPECT_DOUBLE_EQ(motion.end(), 3.0);
}

TEST_F(GltfMotionTest, SpeedAndLoops) {
    VertexMotion motion{vertices_of(test::bending_bar()), 0.0, 2.0, false};
    expect_near(motion.at(0.5)[32], {-1.0, 0.9, -0.1});
    EXPECT_DOUBLE_EQ(motion.end(), 0.5);
    motion.loop = true;
    expect_near(motion.at(5.25)[32], motion.at(0.25)[32]);
    EXPECT_EQ(motion.end(), std::numeric_limits<double>::infinity());
}

TEST_F(GltfMotionTest, InterpolatesAsTheStandardSays) {
    const auto x_at = [&](const char* interpolation, const std::vector<float>& values, double time) {
        return place_vertices(
                   vertices_of(moved_triangle("translation", {1, 3}, values, "VEC3", interpolation)), time,
                   1.0)[1]
                   .x -
               1.0;  // the second morph target, by its own weight
    };
    const std::vector<float> plain = {2, 0, 0, 6, 0, 0};
    for (const double time : {0.0, 1.0}) EXPECT_DOUBLE_EQ(x_at("LINEAR", plain, time), 2.0);
    EXPECT_DOUBLE_EQ(x_at("LINEAR", plain, 1.5), 3.0);
    EXPECT_DOUBLE_EQ(x_at("STEP", plain, 2.9), 2.0);
    EXPECT_DOUBLE_EQ(x_at("STEP", plain, 3.0), 6.0);
    // Tangents are those of x = t^3, which a cubic has exactly.
    const std::vector<float> cubic = {0, 0, 0, 1, 0, 0, 3, 0, 0, 27, 0, 0, 27, 0, 0, 0, 0, 0};
    for (const double time : {1.0, 1.5, 2.25, 3.0})
        EXPECT_NEAR(x_at("CUBICSPLINE", cubic, time), time * time * time, 1e-12);
}

TEST_F(GltfMotionTest, MorphTargetsAddUp) {
    const SkinnedVertices triangle =
        vertices_of(moved_triangle("weights", {0, 1}, {1, 0, 0, 0.5}, "SCALAR", "LINEAR"));
    expect_near(place_vertices(triangle, 0.0, 0.0)[1], {11.0, 1.0, 0.0});  // the mesh's own weights
    expect_near(place_vertices(triangle, 0.0, 1.0)[1], {10.0, 1.0, 2.0});
    expect_near(place_vertices(triangle, 1.0, 1.0)[1], {12.0, 1.0, 0.0});
    expect_near(place_vertices(triangle, 0.5, 1.0)[2], {11.0, 0.0, 2.5});
}

TEST_F(GltfMotionTest, BonesAreTheJointsOfSkins) {
    const SkinnedVertices bones = read_gltf_bones(make("a.glb", test::bending_bar().content()), "bend");
    ASSERT_EQ(bones.joints.size(), 3u);
    EXPECT_EQ(bones.nodes[bones.joints[1].node].name, "middle");
    EXPECT_TRUE(bones.points.empty());
    test::GltfMaker maker = test::bending_bar();
    maker.json.erase("skins");
    maker.json["nodes"][0].erase("skin");
    EXPECT_EQ(read_gltf_bones(make("b.glb", maker.content()), "").joints.size(), 4u) << "all nodes";
}

TEST_F(GltfMotionTest, NamesWhatIsWrong) {
    EXPECT_THAT(refusal([&] { vertices_of(test::bending_bar(), "jump"); }),
                HasSubstr("a.glb: animations = jump: is not there: it has 'bend'"));
    EXPECT_THAT(refusal_of([](Json& json) { json.erase("animations"); }),
                HasSubstr("animations: it has none"));
    EXPECT_THAT(refusal_of([](Json& json) { json["nodes"][0]["skin"] = 3; }),
                HasSubstr("skins = 3: is not there: the file has 1"));
    EXPECT_THAT(refusal_of([](Json& json) { json["skins"][0]["joints"] = {1}; }),
                HasSubstr("JOINTS = 1: must be below 1"));
    EXPECT_THAT(refusal_of([](Json& json) {
                    json["skins"][0]["joints"] = {1, 9};
                }),
                HasSubstr("skins[0].joints = 9: names a node that is not in the scene"));
    EXPECT_THAT(refusal_of([](Json& json) { json["skins"][0]["joints"] = Json::array(); }),
                HasSubstr("skins[0].joints: must name at least one node"));
    EXPECT_THAT(refusal_of([](Json& json) { json["skins"][0]["inverseBindMatrices"] = 0; }),
                HasSubstr("must be 3 of type MAT4"));
    EXPECT_THAT(refusal_of([](Json& json) { json["animations"][0]["samplers"][0]["output"] = 0; }),
                HasSubstr("108 numbers: must be 8"));
    EXPECT_THAT(
        refusal_of([](Json& json) { json["animations"][0]["channels"][0]["target"]["path"] = "color"; }),
        HasSubstr("animations[0]: moves no node of the scene"));
    EXPECT_THAT(refusal_of([](Json& json) { json["animations"][0]["samplers"] = Json::array(); }),
                HasSubstr("a.glb: cannot be read: "));
}

// Every beginning of a file is read or refused; nothing else.
TEST_F(GltfMotionTest, AnyBeginningOfAFileIsReadOrRefused) {
    const std::string whole = test::bending_bar().content();
    for (std::size_t size = 0; size < whole.size(); size += 23) {
        make("a.glb", whole.substr(0, size));
        EXPECT_THROW(read_gltf_vertices(folder_.path() / "a.glb", ""), InvalidInput) << size;
    }
}

}  // namespace
}  // namespace gelatin
