#include "model/assembly/make_animation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/mesh_samples.h"
#include "mesh/surface_file.h"
#include "support/gltf_maker.h"

namespace gelatin {
namespace {

using testing::HasSubstr;

class MakeAnimation : public testing::Test {
protected:
    std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
    // A cube from `x` on.
    void write_cube(const std::string& name, double x) const {
        write_surface(file(name), cube({x, 0.0, 0.0}, 1.0));
    }
    SurfaceMesh surface(const std::string& name) const {
        Notes notes;
        return read_surface(file(name), notes);
    }

    TemporaryFolder folder_;
};

TEST_F(MakeAnimation, TakesFilesInTheOrderOfTheirNumbers) {
    for (const int number : {10, 9, 2, 1}) write_cube("wave_" + std::to_string(number) + ".obj", number);
    write_cube("wave.obj", 77.0);
    const HandleAnimation animation = make_animation({AnimationFiles{file("wave_*.obj"), 10.0}},
                                                     FileShape{file("wave_1.obj")}, surface("wave_1.obj"));
    const auto first_x = [&](double time) { return animation.arms(animation.motion->at(time))[0].x; };
    EXPECT_DOUBLE_EQ(first_x(0.0), 1.0);
    EXPECT_DOUBLE_EQ(first_x(0.1), 2.0);
    EXPECT_DOUBLE_EQ(first_x(0.15), 5.5) << "in between";
    EXPECT_DOUBLE_EQ(first_x(0.2), 9.0);
    EXPECT_DOUBLE_EQ(first_x(9.0), 10.0);
    EXPECT_DOUBLE_EQ(animation.end(), 0.3);
}

// glTF repeats vertices where faces have other normals; repairs merge them, and leave out those of no face.
TEST_F(MakeAnimation, MovesTheVerticesThatRepairsHaveKept) {
    Mesh doubled;
    const SurfaceMesh plain = cube({0.0, 0.0, 0.0}, 1.0);
    doubled.vertices = {{5.0, 5.0, 5.0}};  // of no face
    for (const glm::uvec3& face : plain.faces) {
        const auto first = static_cast<std::uint32_t>(doubled.vertices.size());
        for (int k = 0; k < 3; ++k) doubled.vertices.push_back(plain.positions[face[k]]);
        doubled.triangles.emplace_back(first, first + 1, first + 2);
    }
    auto frames = std::make_shared<std::vector<std::vector<glm::dvec3>>>(1, doubled.vertices);
    for (glm::dvec3& p : frames->front()) p *= 3.0;
    const HandleAnimation animation =
        make_animation({AnimationFrames{frames}}, MeshShape{std::make_shared<const Mesh>(doubled)}, plain);
    EXPECT_EQ(animation.vertex_count, 37u);
    const std::vector<glm::dvec3> arms = animation.arms(animation.motion->at(0.0));
    ASSERT_EQ(arms.size(), 8u);
    for (std::size_t v = 0; v < 8; ++v) EXPECT_EQ(arms[v], 3.0 * plain.positions[v]);
}

TEST_F(MakeAnimation, SaysWhatDoesNotFit) {
    write_cube("a_1.obj", 0.0);
    const SurfaceMesh cube_mesh = surface("a_1.obj");
    const auto refusal_of = [&](const AnimationDescription& animation, const Shape& shape,
                                const SurfaceMesh& mesh) {
        return refusal([&] { make_animation(animation, shape, mesh); });
    };
    const FileShape shape{file("a_1.obj")};
    EXPECT_THAT(refusal_of({AnimationFiles{file("b_*.obj")}}, shape, cube_mesh),
                HasSubstr("b_*.obj: there is no such file"));
    EXPECT_THAT(refusal_of({AnimationFiles{file("a_1.obj")}}, shape, cube_mesh),
                HasSubstr("a_1.obj: must have one * in the name of the files"));
    SurfaceMesh larger = cube({0.0, 0.0, 0.0}, 1.0);
    append(larger, cube({3.0, 0.0, 0.0}, 1.0));
    write_surface(file("a_2.obj"), larger);
    EXPECT_THAT(refusal_of({AnimationFiles{file("a_*.obj")}}, shape, cube_mesh),
                HasSubstr("a_2.obj: vertices = 16: must be 8, as in the first file"));
    EXPECT_THAT(refusal_of({AnimationFiles{file("a_*2.obj")}}, shape, cube_mesh),
                HasSubstr("a_1.obj: vertices = 8: its animation has 16"));
    write_surface(file("far.obj"), cube({1e8, 0.0, 0.0}, 1.0));
    EXPECT_THAT(
        refusal_of({AnimationFiles{file("far*.obj")}}, FileShape{file("far.obj")}, surface("far.obj")),
        HasSubstr("far.obj: is so far from the origin"));
}

TEST_F(MakeAnimation, BonesHoldWhatIsNearest) {
    test::bending_bar().write(file("bar.glb"));
    ObjectDescription object;
    object.scale = 2.0;
    object.position = {1.0, 0.0, 0.0};
    const BodySkeleton skeleton({file("bar.glb"), 0.2}, object, Axis::y);
    // Bones from y = 0 to 2, and from 2 to 4, at x = 1.
    const std::vector<glm::dvec3> points = {{1.15, 0.5, 0.0}, {1.25, 0.5, 0.0}, {1.0, 3.0, 0.1},
                                            {1.0, 4.15, 0.0}, {1.0, 4.25, 0.0}, {1.0, -0.15, 0.0}};
    const BodySkeleton::Held held = skeleton.hold(points);
    EXPECT_EQ(held.nodes, (std::vector<std::uint32_t>{0, 2, 3, 5}));
    const std::vector<glm::dvec3> start = held.animation.arms(held.animation.motion->at(0.0)),
                                  end = held.animation.arms(held.animation.motion->at(1.0));
    for (std::size_t k = 0; k < held.nodes.size(); ++k)
        EXPECT_LT(glm::distance(start[k], points[held.nodes[k]]), 1e-9);
    EXPECT_LT(glm::distance(end[0], points[0]), 1e-9);
    EXPECT_LT(glm::distance(end[1], {0.0, 2.0, 0.1}), 1e-6) << "turned about (1, 2, 0)";
}

}  // namespace
}  // namespace gelatin
