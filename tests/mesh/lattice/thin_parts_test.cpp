#include "mesh/lattice/thin_parts.h"

#include <gtest/gtest.h>

#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"

namespace gelatin::lattice {
namespace {

TEST(ThinPartsTest, MeasureAPlateOnBothSides) {
    const EnclosedSpace space(make_box({{1.0, 0.02, 1.0}, {1, 1, 1}}));
    double area = 0.0;
    for (const ThinPlace& place : ThinParts(space).find(0.05, 0.1)) {
        EXPECT_NEAR(place.thickness, 0.02, 1e-8);
        area += 0.5 * glm::length(glm::cross(place.face[1] - place.face[0], place.face[2] - place.face[0]));
    }
    EXPECT_NEAR(area, 2.0, 0.01);
    EXPECT_TRUE(ThinParts(space).find(0.019, 0.1).empty());
}

// What is known from other searches changes nothing, whether they were wider or narrower.
TEST(ThinPartsTest, ASearchAfterOthersFindsTheSame) {
    SurfaceMesh surface = make_sphere({0.5, 6});
    append(surface, make_box({{2.0, 0.03, 0.5}, {2, 1, 1}}));
    append(surface, cube({1.5, 1.5, 1.5}, 0.05));
    const EnclosedSpace space(surface);
    ThinParts later(space);
    later.find(0.1, 0.1);
    later.find(0.01, 0.2);
    for (const double thickness : {0.05, 0.3}) {
        const auto found = later.find(thickness, 0.1), fresh = ThinParts(space).find(thickness, 0.1);
        ASSERT_EQ(found.size(), fresh.size());
        EXPECT_FALSE(found.empty());
        for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_EQ(found[k].face, fresh[k].face);
            EXPECT_NEAR(found[k].thickness, fresh[k].thickness, 1e-12);
            EXPECT_EQ(found[k].is_small_piece, fresh[k].is_small_piece);
        }
    }
}

}  // namespace
}  // namespace gelatin::lattice
