// How surfaces look, as their files say.
#include "mesh/surface_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "mesh/mesh_samples.h"
#include "mesh/surface_file.h"
#include "mesh/texture_samples.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The second face is wound inwards, the last one has no area.
const std::string kObj =
    "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvt 0.5 0.25\n"
    "usemtl red\nf 1/1 3/3 2/2\nf 1/1 4/4 2/2\nusemtl picture\nf 1/1 4/4 3/3\nf 2/2 3/3 4/4\nf 2/2 2/3 4/4\n";
const std::string kMtl = "newmtl red\nKd 1 0 0.5\nnewmtl picture\nKd 0 0 0\nmap_Kd paint.png\nnewmtl other\n";

class SurfaceImportTest : public testing::Test {
protected:
    void make(const std::string& name, const std::string& content) {
        std::ofstream(folder_.path() / name, std::ios::binary) << content;
    }
    SurfaceMesh read(const std::string& name) { return read_surface(folder_.path() / name, notes_); }

    TemporaryFolder folder_;
    Notes notes_;
};

glm::vec2 uv_at(const SurfaceMesh& mesh, std::size_t face, const glm::dvec3& corner) {
    for (int k = 0; k < 3; ++k) {
        if (mesh.positions[mesh.faces[face][k]] == corner)
            return mesh.look.corner_uvs[face][static_cast<std::size_t>(k)];
    }
    return glm::vec2(-1.0f);
}

TEST_F(SurfaceImportTest, ObjKeepsMaterialsAndCoordinatesThroughRepair) {
    make("a.obj", kObj);
    make("paint.mtl", kMtl);
    make("paint.png", png_sample());
    const SurfaceMesh mesh = read("a.obj");
    ASSERT_EQ(mesh.faces.size(), 4u) << "one is discarded, one is flipped";
    ASSERT_EQ(mesh.look.materials.size(), 2u) << "that of no face is left out";
    EXPECT_THAT(mesh.look.face_materials, ElementsAre(0u, 0u, 1u, 1u));
    ASSERT_EQ(mesh.look.corner_uvs.size(), 4u);
    for (std::size_t f = 0; f < 4; ++f) {
        for (const auto& [corner, uv] : {std::pair(glm::dvec3(0, 0, 0), glm::vec2(0, 0)),
                                         {glm::dvec3(1, 0, 0), glm::vec2(1, 0)},
                                         {glm::dvec3(0, 1, 0), glm::vec2(0, 1)},
                                         {glm::dvec3(0, 0, 1), glm::vec2(0.5f, 0.25f)}}) {
            const glm::vec2 found = uv_at(mesh, f, corner);
            EXPECT_TRUE(found == uv || found == glm::vec2(-1.0f)) << f;
        }
    }
    const SurfaceMaterial &red = mesh.look.materials[0], &picture = mesh.look.materials[1];
    EXPECT_EQ(red.name, "red");
    EXPECT_NEAR(red.color.b, 0.214f, 1e-3f) << "linear, of sRGB's 0.5";
    EXPECT_EQ(red.image, nullptr);
    EXPECT_EQ(picture.color, glm::vec3(1.0f)) << "not black";
    ASSERT_NE(picture.image, nullptr);
    EXPECT_EQ(*picture.image, png_sample());
}

TEST_F(SurfaceImportTest, WhatIsMissingIsLeftOut) {
    make("a.obj", kObj);
    SurfaceMesh mesh = read("a.obj");
    EXPECT_TRUE(mesh.look.is_empty());
    EXPECT_TRUE(mesh.look.face_materials.empty());
    EXPECT_EQ(mesh.look.corner_uvs.size(), 4u);
    EXPECT_THAT(notes_, testing::Contains(HasSubstr("'paint.mtl' cannot be read")));

    notes_.clear();
    make("paint.mtl", kMtl);
    make("paint.png", "no picture");
    mesh = read("a.obj");
    EXPECT_EQ(mesh.look.materials.at(1).image, nullptr);
    EXPECT_THAT(notes_,
                testing::Contains(HasSubstr("the texture 'paint.png' of material 'picture' is left out: ")));
    EXPECT_THAT(notes_, testing::Contains(HasSubstr("is neither a PNG nor a JPEG file")));
}

TEST_F(SurfaceImportTest, WithoutMaterialsAFileHasNoLook) {
    make("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const SurfaceMesh mesh = read("a.obj");
    EXPECT_TRUE(mesh.look.is_empty());
    EXPECT_TRUE(mesh.look.face_materials.empty());
    EXPECT_TRUE(mesh.look.corner_uvs.empty());
    EXPECT_THAT(notes_, IsEmpty());
}

// The binary form: a header of three numbers, a chunk with the text, and one with the bytes of its buffer.
std::string glb_of(std::string text) {
    const std::string uri = ",\"uri\":\"data:application/octet-stream;base64,";
    const std::size_t start = text.find(uri), data = start + uri.size(), end = text.find('"', data);
    const std::string buffer = from_base64(text.substr(data, end - data));
    text.erase(start, end + 1 - start);
    while (text.size() % 4 != 0) text += ' ';
    const auto word = [](std::size_t value) {
        std::string bytes;
        for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 255);
        return bytes;
    };
    return "glTF" + word(2) + word(28 + text.size() + buffer.size()) + word(text.size()) + "JSON" + text +
           word(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

TEST_F(SurfaceImportTest, GltfHasItsNodesTransformsAndTextures) {
    make("pa int.png", png_sample());
    make("file.gltf", gltf_sample("pa%20int.png"));
    make("embedded.gltf", gltf_sample("data:image/png;base64," + kPngText));
    make("binary.glb", glb_of(gltf_sample("data:image/png;base64," + kPngText)));
    for (const char* name : {"file.gltf", "embedded.gltf", "binary.glb"}) {
        const SurfaceMesh mesh = read(name);
        EXPECT_THAT(notes_, IsEmpty());
        ASSERT_EQ(mesh.faces.size(), 4u);
        ASSERT_EQ(mesh.positions.size(), 4u);
        EXPECT_EQ(mesh.positions[1], glm::dvec3(7, 0, 0));
        EXPECT_EQ(mesh.positions[3], glm::dvec3(5, 0, 2));
        ASSERT_EQ(mesh.look.materials.size(), 1u);
        EXPECT_EQ(mesh.look.materials[0].name, "paint");
        EXPECT_EQ(mesh.look.materials[0].color, glm::vec3(0.5f, 1.0f, 1.0f)) << "linear already";
        ASSERT_NE(mesh.look.materials[0].image, nullptr) << name;
        EXPECT_EQ(*mesh.look.materials[0].image, png_sample());
        EXPECT_EQ(uv_at(mesh, 0, {5, 0, 0}), glm::vec2(0.0f, 1.0f)) << "its v points down";
        EXPECT_THAT(mesh.look.face_materials, testing::Each(0u));
    }
}

TEST_F(SurfaceImportTest, RefusesDamagedGltfWithItsName) {
    make("a.gltf", "{\"asset\":");
    make("b.glb", "glTF nonsense");
    make("c.gltf", gltf_sample("x.png").replace(80, 1, ""));
    for (const char* name : {"a.gltf", "b.glb"})
        EXPECT_THAT(refusal([&] { read(name); }), HasSubstr(std::string(name) + ": cannot be read: "));
    try {
        read("c.gltf");
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("c.gltf"));
    }
}

// Every beginning of a file is a mesh or is refused; nothing else.
TEST_F(SurfaceImportTest, AnyBeginningOfAGltfFileIsReadOrRefused) {
    const std::string whole = gltf_sample("data:image/png;base64," + kPngText);
    for (std::size_t size = 0; size < whole.size(); size += 7) {
        make("a.gltf", whole.substr(0, size));
        EXPECT_THROW(read("a.gltf"), InvalidInput) << size;
    }
}

}  // namespace
}  // namespace gelatin
