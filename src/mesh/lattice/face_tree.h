#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin::lattice {

using Triangle = std::array<glm::dvec3, 3>;

/// Where a segment crosses a face.
struct Crossing {
    double at;           ///< fraction of the segment, in [0, 1]
    std::uint32_t face;  ///< index in FaceTree::faces()
};

/// The point of a surface that is nearest to another.
struct NearestPoint {
    glm::dvec3 point;
    std::uint32_t face;  ///< index in FaceTree::faces()
};

/// A binary tree of boxes over the faces of a surface. A node's faces are contiguous in `faces()`.
class FaceTree {
public:
    struct Node {
        glm::dvec3 min, max;
        std::uint32_t first, count;  ///< its faces
        std::uint32_t right;         ///< index of its second child; the first is the next node; 0: a leaf
    };

    explicit FaceTree(const SurfaceMesh& surface);

    std::span<const Node> nodes() const { return nodes_; }               ///< parents before their children
    std::span<const Triangle> faces() const { return faces_; }           ///< in the tree's order
    std::span<const std::uint32_t> sources() const { return sources_; }  ///< each face's index in the surface
    std::span<const Triangle> faces_of(const Node& node) const {
        return faces().subspan(node.first, node.count);
    }

    /// Where the segment from `a` to `b` crosses faces, in ascending order. Replaces what `found` contains.
    void find_crossings(const glm::dvec3& a, const glm::dvec3& b, std::vector<Crossing>& found) const;

    /// The point of the surface that is nearest to `p`, if one is nearer than `radius`.
    std::optional<NearestPoint> find_nearest(const glm::dvec3& p, double radius) const;

private:
    struct Builder;
    std::vector<Node> nodes_;
    std::vector<Triangle> faces_;
    std::vector<std::uint32_t> sources_;
};

/// The point of a triangle that is nearest to `p`.
glm::dvec3 nearest_point(const Triangle& face, const glm::dvec3& p);

}  // namespace gelatin::lattice
