// How OBJ files look, as their MTL files say.
#include "mesh/obj_materials.h"

#include "mesh/surface_file_fixture.h"
#include "mesh/texture_samples.h"

namespace gelatin {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ObjMaterialsTest : public SurfaceFileFixture {};

// The second face is wound inwards, the last one has no area.
const std::string kObjWithMaterials =
    "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvt 0.5 0.25\n"
    "usemtl red\nf 1/1 3/3 2/2\nf 1/1 4/4 2/2\nusemtl picture\nf 1/1 4/4 3/3\nf 2/2 3/3 4/4\nf 2/2 2/3 4/4\n";
const std::string kMtl = "newmtl red\nKd 1 0 0.5\nnewmtl picture\nKd 0 0 0\nmap_Kd paint.png\nnewmtl other\n";

TEST_F(ObjMaterialsTest, ObjKeepsMaterialsAndCoordinatesThroughRepair) {
    make("a.obj", kObjWithMaterials);
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

TEST_F(ObjMaterialsTest, WhatIsMissingIsLeftOut) {
    make("a.obj", kObjWithMaterials);
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

TEST_F(ObjMaterialsTest, WithoutMaterialsAFileHasNoLook) {
    make("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const SurfaceMesh mesh = read("a.obj");
    EXPECT_TRUE(mesh.look.is_empty());
    EXPECT_TRUE(mesh.look.face_materials.empty());
    EXPECT_TRUE(mesh.look.corner_uvs.empty());
    EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(ObjMaterialsTest, ReadsMtlAsOtherProgramsWriteIt) {
    const std::string faces =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl two words\nf 1 3 2\nf 1 2 4\nusemtl 2#3\n"
        "f 1 4 3\nusemtl none\nf 2 3 4\n";
    std::filesystem::create_directory(folder_.path() / "of paint");
    make("of paint/pic ture.png", png_sample());
    make("of paint/first file.mtl",
         "# x\r\n\r\n  newmtl two words  \r\n\tKd 0 .5 1.\r\n\tmap_Kd -s 2 2 -clamp on -o 0 0 0 "
         "pic ture.png\r\n\tmap_Bump -bm 0.5 other.png\r\n");
    make("second.mtl", "NEWMTL 2#3\nKd 1\nKa 0 0 0\nd 0.5\n");
    make("a.obj", "mtllib of paint\\first file.mtl second.mtl\n" + faces);
    const SurfaceMesh mesh = read("a.obj");
    EXPECT_THAT(notes_, ElementsAre("no material file defines 'none', which faces have: 1"));
    ASSERT_EQ(mesh.look.materials.size(), 2u);
    EXPECT_THAT(mesh.look.face_materials, ElementsAre(0u, 0u, 1u, SurfaceLook::kNone));
    EXPECT_EQ(mesh.look.materials[0].name, "two words");
    EXPECT_NEAR(mesh.look.materials[0].color.g, 0.214f, 1e-3f);
    EXPECT_EQ(mesh.look.materials[0].image_name, "pic ture.png");
    ASSERT_NE(mesh.look.materials[0].image, nullptr);
    EXPECT_EQ(mesh.look.materials[1].color, glm::vec3(1.0f));
}

// A comment begins where a line or white space ends, and not with the first word of a name.
TEST_F(ObjMaterialsTest, NamesMayContainHashes) {
    make("#1 b# c.mtl",
         "newmtl bore# red\nKd 1 0 0\nnewmtl #0000ff # blue\nKd 0 0 1\nnewmtl #00ff00\nKd 0 1 0\n");
    make(
        "a.obj",
        "mtllib #1 b# c.mtl # the only one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl bore# red # of \\ it\n"
        "f 1 3 2\nusemtl #0000ff\nf 1 2 4\nusemtl #00ff00\nf 1 4 3\nusemtl # none\nf 2 3 4\n");
    const SurfaceMesh mesh = read("a.obj");
    EXPECT_THAT(notes_, ElementsAre("no material file defines '', which faces have: 1"));
    ASSERT_EQ(mesh.look.materials.size(), 3u);
    EXPECT_THAT(mesh.look.face_materials, ElementsAre(0u, 1u, 2u, SurfaceLook::kNone));
    EXPECT_EQ(mesh.look.materials[0].color, glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.look.materials[1].color, glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.look.materials[2].color, glm::vec3(0, 1, 0));
}

TEST_F(ObjMaterialsTest, LeavesOutTheRestOfADamagedFile) {
    make("paint.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 x 0\nnewmtl blue\nKd 0 0 1\n");
    make("a.obj",
         "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 "
         "4\n");
    const SurfaceMesh mesh = read("a.obj");
    ASSERT_EQ(mesh.look.materials.size(), 1u);
    EXPECT_EQ(mesh.look.materials[0].color, glm::vec3(1, 0, 0));
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("the materials from here on are left out: ")));
    EXPECT_THAT(notes_[0], HasSubstr("paint.mtl:4: Kd = x: must be a number"));
}

}  // namespace
}  // namespace gelatin
