#include "model/corners.h"

#include <gtest/gtest.h>

#include <array>

namespace gelatin {
namespace {

TEST(Corners, AreThoseOfFaces) {
    const Face face{4, 7, 2, 0};
    EXPECT_EQ(corners_of(face), (std::array<std::uint32_t, 3>{4, 7, 2}));
    for (const std::uint32_t node : {4u, 7u, 2u}) EXPECT_TRUE(has_corner(face, node)) << node;
    for (const std::uint32_t node : {0u, 3u, 5u}) EXPECT_FALSE(has_corner(face, node)) << node;
}

// Whichever corners of the two it is. The object is no corner.
TEST(Corners, OfTwoFacesAreSharedInAnyOrder) {
    const std::array<std::uint32_t, 3> first{0, 1, 2}, second{3, 4, 5};
    const Face f{first[0], first[1], first[2], 5};
    EXPECT_FALSE(share_corner(f, {second[0], second[1], second[2], 1}));
    EXPECT_TRUE(share_corner(f, f));
    for (std::size_t of_first = 0; of_first < 3; ++of_first) {
        for (std::size_t of_second = 0; of_second < 3; ++of_second) {
            std::array<std::uint32_t, 3> nodes = second;
            nodes[of_second] = first[of_first];
            EXPECT_TRUE(share_corner(f, {nodes[0], nodes[1], nodes[2], 1})) << of_first << of_second;
        }
    }
}

// Neither the object nor the owner is an end.
TEST(Corners, OfTwoEdgesAreTheirEnds) {
    const FaceEdge edge{1, 2, 5, 6};
    EXPECT_FALSE(share_end(edge, {3, 4, 5, 6}));
    EXPECT_FALSE(share_end(edge, {5, 6, 1, 2}));
    EXPECT_TRUE(share_end(edge, edge));
    for (const FaceEdge& other : {FaceEdge{1, 4, 0, 0}, {0, 1, 0, 0}, {2, 4, 0, 0}, {0, 2, 0, 0}})
        EXPECT_TRUE(share_end(edge, other)) << other.a << " " << other.b;
}

}  // namespace
}  // namespace gelatin
