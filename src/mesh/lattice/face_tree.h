#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "mesh/box_nodes.h"
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
    explicit FaceTree(const SurfaceMesh& surface, std::uint32_t faces_in_leaf = 8);

    std::span<const BoxNode> nodes() const { return tree_.nodes; }  ///< parents before their children
    std::span<const Triangle> faces() const { return faces_; }      ///< in the tree's order
    std::span<const std::uint32_t> sources() const {
        return tree_.order;
    }  ///< each face's index in the surface
    std::span<const Triangle> faces_of(const BoxNode& node) const {
        return faces().subspan(node.first, node.count);
    }

    /// Where the segment from `a` to `b` crosses faces, in ascending order. Replaces what `found` contains.
    void find_crossings(const glm::dvec3& a, const glm::dvec3& b, std::vector<Crossing>& found) const;

    /// The point of the surface that is nearest to `p`, if one is nearer than `radius`.
    std::optional<NearestPoint> find_nearest(const glm::dvec3& p, double radius) const;

private:
    BoxNodes tree_;
    std::vector<Triangle> faces_;
};

/// The point of a triangle that is nearest to `p`.
glm::dvec3 nearest_point(const Triangle& face, const glm::dvec3& p);

}  // namespace gelatin::lattice
