#include "sim/animation/animation_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/shapes.h"
#include "model/skin.h"
#include "sim/animation/animated_surface.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

// Two balls above a plane, and a box below it.
class AnimationFileTest : public testing::Test {
protected:
    AnimationFileTest()
        : simulator_(scene(), on_cpu()), surface_(make_animated_surface(model_of(simulator_))) {
        for (int k = 0; k < 5; ++k) {
            if (k > 0) simulator_.advance_frame();
            simulator_.advance_frame();
            frames_.push_back(simulator_.read_frame());
        }
    }

    static Scene scene() {
        Scene scene = test::falling_balls();
        scene.simulation.solver = SolverKind::implicit;
        scene.objects[0].name = "1st ball, \"red\"";
        ColliderDescription box;
        box.shape = BoxShape{.size = {2, 0.2, 2}};
        box.position = {0, -0.2, 0};
        scene.colliders.push_back(box);
        return scene;
    }
    static SimulatorOptions on_cpu() {
        SimulatorOptions options;
        options.backend = Backend::cpu;
        return options;
    }

    fs::path write(const std::string& name, Axis up = Axis::y) const {
        const fs::path file = folder_.path() / name;
        AnimationSettings settings{500.0, std::vector<glm::vec3>(3, glm::vec3(0.5f, 0.25f, 0.125f)), up};
        const auto animation = make_animation_file(file, model_of(simulator_), settings);
        for (const HostFrame& frame : frames_) animation->write(frame);
        animation->finish();
        return file;
    }

    // x, y, z of the drawn points of a frame, and of those of an object.
    std::vector<float> points(std::size_t frame) const {
        return carry_skin(surface_.points, std::span(frames_[frame].positions));
    }
    std::vector<float> points(std::size_t frame, std::size_t object) const {
        const std::vector<float> all = points(frame);
        const Range& range = surface_.objects[object].points;
        return {all.begin() + 3 * range.first, all.begin() + 3 * range.end()};
    }

    TemporaryFolder folder_;
    Simulator simulator_;
    AnimatedSurface surface_;
    std::vector<HostFrame> frames_;
};

std::uint32_t number_at(const std::string& bytes, std::size_t offset, bool is_big = false) {
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < 4; ++k)
        number |= std::uint32_t{static_cast<unsigned char>(bytes[offset + k])} << (8 * (is_big ? 3 - k : k));
    return number;
}
float float_at(const std::string& bytes, std::size_t offset, bool is_big = false) {
    return std::bit_cast<float>(number_at(bytes, offset, is_big));
}

TEST_F(AnimationFileTest, Pc2HasThePointsOfEachFrame) {
    const std::string bytes = read_file(write("balls.pc2"));
    const std::size_t count = surface_.points.size();
    ASSERT_EQ(bytes.size(), 32 + frames_.size() * count * 12);
    EXPECT_EQ(bytes.substr(0, 12), std::string("POINTCACHE2\0", 12));
    EXPECT_EQ(number_at(bytes, 12), 1u);
    EXPECT_EQ(number_at(bytes, 16), count);
    EXPECT_EQ(float_at(bytes, 20), 1.0f);  // first frame
    EXPECT_EQ(float_at(bytes, 24), 2.0f);  // frames from one to the next
    EXPECT_EQ(number_at(bytes, 28), frames_.size());
    for (std::size_t f = 0; f < frames_.size(); ++f) {
        const std::vector<float> expected = points(f);
        for (std::size_t k = 0; k < expected.size(); ++k)
            ASSERT_EQ(float_at(bytes, 32 + 4 * (f * expected.size() + k)), expected[k]);
    }
}

TEST_F(AnimationFileTest, MddHasTimesAndPointsOfEachFrame) {
    const std::string bytes = read_file(write("balls.mdd"));
    const std::size_t count = surface_.points.size(), first = 8 + 4 * frames_.size();
    ASSERT_EQ(bytes.size(), first + frames_.size() * count * 12);
    EXPECT_EQ(number_at(bytes, 0, true), frames_.size());
    EXPECT_EQ(number_at(bytes, 4, true), count);
    for (std::size_t f = 0; f < frames_.size(); ++f) {
        EXPECT_EQ(float_at(bytes, 8 + 4 * f, true), static_cast<float>(frames_[f].time));
        const std::vector<float> expected = points(f);
        for (std::size_t k = 0; k < expected.size(); ++k)
            ASSERT_EQ(float_at(bytes, first + 4 * (f * expected.size() + k), true), expected[k]);
    }
}

// Read by Assimp.
TEST_F(AnimationFileTest, GltfHasAMorphTargetForEachFrame) {
    Assimp::Importer importer;
    const aiScene* const read = importer.ReadFile(write("balls.glb").string(), 0);
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    ASSERT_EQ(read->mNumMeshes, 3u);
    for (std::size_t o = 0; o < 3; ++o) {
        const aiMesh& mesh = *read->mMeshes[o];
        const AnimatedSurface::Object& object = surface_.objects[o];
        const bool moves = o < 2;
        ASSERT_EQ(mesh.mNumVertices, object.vertices.size());
        ASSERT_EQ(mesh.mNumFaces, object.parts[0].corners.size() / 3);
        ASSERT_EQ(mesh.mNumAnimMeshes, moves ? frames_.size() - 1 : 0);
        for (std::size_t f = 0; f < (moves ? frames_.size() : 1); ++f) {
            const aiVector3D* const vertices = f == 0 ? mesh.mVertices : mesh.mAnimMeshes[f - 1]->mVertices;
            const aiVector3D* const normals = f == 0 ? mesh.mNormals : mesh.mAnimMeshes[f - 1]->mNormals;
            const std::vector<glm::vec3> positions = vertex_positions(object, points(f, o)),
                                         expected = vertex_normals(object, points(f, o));
            for (std::size_t v = 0; v < positions.size(); ++v) {
                EXPECT_LT(glm::distance(glm::vec3(vertices[v].x, vertices[v].y, vertices[v].z), positions[v]),
                          1e-6f);
                EXPECT_LT(glm::distance(glm::vec3(normals[v].x, normals[v].y, normals[v].z), expected[v]),
                          1e-6f);
            }
        }
    }
    ASSERT_EQ(read->mNumAnimations, 1u);
    ASSERT_EQ(read->mAnimations[0]->mNumMorphMeshChannels, 2u);
    const aiMeshMorphAnim& channel = *read->mAnimations[0]->mMorphMeshChannels[0];
    ASSERT_EQ(channel.mNumKeys, frames_.size());
    for (std::size_t f = 0; f < frames_.size(); ++f)
        for (unsigned w = 0; w < channel.mKeys[f].mNumValuesAndWeights; ++w)
            EXPECT_EQ(channel.mKeys[f].mWeights[w], w + 1 == f ? 1.0 : 0.0);
    aiColor4D color;
    read->mMaterials[0]->Get(AI_MATKEY_COLOR_DIFFUSE, color);
    EXPECT_EQ(color, aiColor4D(0.5f, 0.25f, 0.125f, 1.0f));
}

// glTF is y-up by its standard, USD says what is up.
TEST_F(AnimationFileTest, KnowsTheScenesUpAxis) {
    Assimp::Importer importer;
    const aiScene* const read = importer.ReadFile(write("balls.glb", Axis::z).string(), 0);
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    ASSERT_EQ(read->mRootNode->mNumChildren, 3u);
    for (unsigned o = 0; o < 3; ++o) {
        const aiVector3D turned =
            read->mRootNode->mChildren[o]->mTransformation * aiVector3D(1.0f, 2.0f, 3.0f);
        EXPECT_LT(glm::distance(glm::vec3(turned.x, turned.y, turned.z), glm::vec3(1, 3, -2)), 1e-6f);
    }
    EXPECT_THAT(read_file(write("balls.usda", Axis::z)), testing::HasSubstr("upAxis = \"Z\""));
    EXPECT_THAT(read_file(write("balls.usda")), testing::HasSubstr("upAxis = \"Y\""));
}

TEST_F(AnimationFileTest, NormalsPointOutwards) {
    const std::vector<glm::vec3> positions = vertex_positions(surface_.objects[2], points(0, 2)),
                                 normals = vertex_normals(surface_.objects[2], points(0, 2));
    for (std::size_t v = 0; v < positions.size(); ++v) {
        EXPECT_GT(glm::dot(positions[v] + glm::vec3(0, 0.2f, 0), normals[v]), 0.0f);
        EXPECT_NEAR(glm::length(normals[v]), 1.0f, 1e-6f);
    }
}

TEST_F(AnimationFileTest, UsdHasTimeSamplesOfSurfacesAndTets) {
    const std::string text = read_file(write("balls.usda"));
    EXPECT_TRUE(text.starts_with("#usda 1.0\n"));
    EXPECT_THAT(text,
                testing::HasSubstr("startTimeCode = 1\n    endTimeCode = 9\n    timeCodesPerSecond = 500\n"));
    EXPECT_THAT(text,
                testing::HasSubstr(
                    "def Mesh \"_1st_ball___red_\" (\n        displayName = \"1st ball, \\\"red\\\"\"\n"));
    EXPECT_THAT(text, testing::HasSubstr("def Mesh \"ball_1\""));
    EXPECT_THAT(text, testing::HasSubstr("def TetMesh \"ball_1_tets\""));
    EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
    // The first vertex of each frame.
    const std::size_t mesh = text.find("def Mesh \"ball_1\"");
    std::size_t at = text.find("point3f[] points.timeSamples", mesh);
    for (std::size_t f = 0; f < frames_.size(); ++f) {
        const glm::vec3 first = vertex_positions(surface_.objects[1], points(f, 1))[0];
        const std::string start = std::to_string(frames_[f].frame) + ": [(";
        at = text.find(start, at);
        ASSERT_NE(at, std::string::npos);
        EXPECT_EQ(std::stof(text.substr(at + start.size(), 20)), first.x);
    }
}

// A box whose vertices a program moves, each by its own way.
class AnimationOfCollider : public AnimationFileTest {
protected:
    AnimationOfCollider() {
        Scene scene = this->scene();
        const auto mesh = std::make_shared<Mesh>();
        const SurfaceMesh box = make_box({{2.0, 0.2, 2.0}, {1, 1, 1}});
        mesh->vertices = box.positions;
        mesh->triangles = box.faces;
        scene.colliders.back().name = "plate";
        scene.colliders.back().shape = MeshShape{mesh};
        scene.colliders.back().animation = AnimationDescription{AnimationByProgram()};
        Simulator moved(scene, on_cpu());
        frames_ = {moved.read_frame()};
        for (int k = 0; k < 3; ++k) {
            for (std::size_t v = 0; v < 8; ++v) mesh_[v] = box.positions[v];
            for (std::size_t v = 0; v < 8; ++v) mesh_[v].y -= 1e-3 * (k + 1) * static_cast<double>(v + 1);
            moved.set_collider_vertices("plate", {mesh_.begin(), mesh_.end()});
            moved.advance_frame();
            frames_.push_back(moved.read_frame());
        }
        simulator_ = std::move(moved);
        surface_ = make_animated_surface(model_of(simulator_));
    }

    // Where the last frame has the vertices, in the scene.
    std::vector<glm::vec3> last() const {
        std::vector<glm::vec3> vertices;
        for (const glm::dvec3& p : mesh_) vertices.emplace_back(p + glm::dvec3(0.0, -0.2, 0.0));
        return vertices;
    }
    static void expect_all_among(const std::vector<glm::vec3>& found, const std::vector<glm::vec3>& wanted) {
        for (const glm::vec3& p : wanted)
            EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                                    [&](const glm::vec3& other) { return glm::distance(p, other) < 2e-6f; }))
                << p.x << " " << p.y << " " << p.z;
    }

    std::array<glm::dvec3, 8> mesh_;
};

TEST_F(AnimationOfCollider, GltfHasItsVerticesInEachFrame) {
    Assimp::Importer importer;
    const aiScene* const read = importer.ReadFile(write("plate.glb").string(), 0);
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    const aiMesh& plate = *read->mMeshes[2];
    ASSERT_EQ(plate.mNumAnimMeshes, 3u);
    std::vector<glm::vec3> found;
    for (unsigned v = 0; v < plate.mNumVertices; ++v) {
        const aiVector3D& p = plate.mAnimMeshes[2]->mVertices[v];
        found.emplace_back(p.x, p.y, p.z);
    }
    expect_all_among(found, last());
}

TEST_F(AnimationOfCollider, UsdHasItsVerticesInEachFrame) {
    const std::string text = read_file(write("plate.usda"));
    std::size_t at = text.find("point3f[] points.timeSamples", text.find("def Mesh \"plate\""));
    at = text.find("3: [", at);
    ASSERT_NE(at, std::string::npos);
    std::vector<glm::vec3> found;
    for (const std::size_t end = text.find(']', at); (at = text.find('(', at)) < end; ++at) {
        glm::vec3 p;
        ASSERT_EQ(std::sscanf(text.c_str() + at, "(%f, %f, %f)", &p.x, &p.y, &p.z), 3);
        found.push_back(p);
    }
    expect_all_among(found, last());
}

TEST_F(AnimationFileTest, UsdHasNoTetsOfRigidBodies) {
    Scene scene = this->scene();
    scene.objects[0].rigid.emplace();
    const Simulator simulator(scene, on_cpu());
    const fs::path file = folder_.path() / "rigid.usda";
    const auto animation =
        make_animation_file(file, model_of(simulator), {60.0, std::vector<glm::vec3>(3), Axis::y});
    animation->write(simulator.read_frame());
    animation->finish();
    const std::string text = read_file(file);
    EXPECT_THAT(text, testing::HasSubstr("def Mesh \"_1st_ball___red_\""));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("def TetMesh \"_1st_ball___red__tets\"")));
    EXPECT_THAT(text, testing::HasSubstr("def TetMesh \"ball_1_tets\""));
}

TEST_F(AnimationFileTest, OtherEndingsAreRefused) {
    EXPECT_THROW(write("balls.fbx"), InvalidInput);
}

}  // namespace
}  // namespace gelatin
