#include "model/assembly/tet_materials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gelatin/error.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Three cubes in a row along x, six tets each.
ObjectDescription row_of_cubes(TetMesh& mesh) {
    mesh = test::make_block({3, 1, 1}, {3, 1, 1});
    ObjectDescription object;
    object.name = "row";
    return object;
}

std::vector<std::uint32_t> cube(const std::vector<std::uint32_t>& materials, int index) {
    return {materials.begin() + 6 * index, materials.begin() + 6 * (index + 1)};
}

TEST(TetMaterials, WithoutPartsAreNone) {
    TetMesh mesh;
    const ObjectDescription object = row_of_cubes(mesh);
    EXPECT_THAT(choose_tet_materials(object, mesh, ""), IsEmpty());
}

TEST(TetMaterials, LaterPartsWin) {
    TetMesh mesh;
    ObjectDescription object = row_of_cubes(mesh);
    object.parts = {{BoxRegion{{0.9, -1, -1}, {4, 2, 2}}, "bone", 0},
                    {HalfSpaceRegion{{-1, 0, 0}, -2.0}, "steel", 0}};
    const auto materials = choose_tet_materials(object, mesh, "");
    EXPECT_THAT(cube(materials, 0), Each(0u));
    EXPECT_THAT(cube(materials, 1), Each(1u));
    EXPECT_THAT(cube(materials, 2), Each(2u));
}

TEST(TetMaterials, GoByTheAttributesOfTheFile) {
    TetMesh mesh;
    ObjectDescription object = row_of_cubes(mesh);
    for (int t = 0; t < 18; ++t) mesh.attributes.push_back(t < 6 ? -3 : 7);
    object.parts = {{TetAttribute{7}, "bone", 0}};
    const auto materials = choose_tet_materials(object, mesh, "");
    EXPECT_THAT(cube(materials, 0), Each(0u));
    EXPECT_THAT(cube(materials, 1), Each(1u));
    EXPECT_THAT(cube(materials, 2), Each(1u));
}

std::string refusal(const ObjectDescription& object, const TetMesh& mesh) {
    try {
        choose_tet_materials(object, mesh, "scene.toml");
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "not refused";
}

TEST(TetMaterials, RefusesPartsWithoutTets) {
    TetMesh mesh;
    ObjectDescription object = row_of_cubes(mesh);
    object.parts = {{SphereRegion{{9, 9, 9}, 1.0}, "bone", 12}};
    EXPECT_EQ(
        refusal(object, mesh),
        "scene.toml:12: object.row.part[0].region: holds the centroid of no tet of the object (regions are "
        "in world coordinates)");
    object.parts = {{TetAttribute{2}, "bone", 12}};
    EXPECT_EQ(
        refusal(object, mesh),
        "scene.toml:12: object.row.part[0].attribute = 2: no tet has it: the object's mesh gives its tets "
        "no attributes");
    for (int t = 0; t < 18; ++t) mesh.attributes.push_back(t < 6 ? 1 : 3);
    EXPECT_EQ(refusal(object, mesh),
              "scene.toml:12: object.row.part[0].attribute = 2: no tet has it; there are 1, 3");
}

}  // namespace
}  // namespace gelatin
