#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "mesh/lattice/face_tree.h"

namespace gelatin::lattice {

/// How often a closed surface winds around points: the faces that a ray along one axis crosses, those that
/// it leaves the inside through less those that it enters through.
///
/// The plane across the rays is divided into rectangles, each with the faces over it. Long thin faces are in
/// many rectangles, and each rectangle has few faces, where boxes around whole faces would overlap.
class FaceColumns {
public:
    /// @param faces every edge is used as often in one direction as in the other
    explicit FaceColumns(std::span<const Triangle> faces);

    /// An integer for any `p`, exact but for points that are on the surface to rounding.
    int winding_number(const glm::dvec3& p) const;

    /// The number of faces that winding_number() tests.
    std::size_t candidates(const glm::dvec3& p) const { return faces_over(turned(p)).size(); }

private:
    // A face over a rectangle, and its extent, rounded outwards.
    struct Listed {
        float low_y, high_y, high_x, high_z;
        std::uint32_t face;
    };
    struct Node {
        double at = 0.0;                   // where the rectangle is divided
        int axis = 0;                      // 0 or 1, across which it is divided
        std::uint32_t child = 0;           // its first child; the second is the next node; 0: a leaf
        std::uint32_t first = 0, end = 0;  // a leaf's faces, in listed_
    };
    struct Builder;

    // With the rays along the last coordinate.
    glm::dvec3 turned(const glm::dvec3& p) const {
        return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3], p[axis_]};
    }
    /// @param p turned
    std::span<const Listed> faces_over(const glm::dvec3& p) const;

    int axis_ = 0;
    std::vector<Triangle> faces_;  // turned
    std::vector<Node> nodes_;
    std::vector<Listed> listed_;
};

}  // namespace gelatin::lattice
