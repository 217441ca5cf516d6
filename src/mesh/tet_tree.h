#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "mesh/box_nodes.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// The barycentric coordinates of `p` in a tet: they sum to 1, and some are negative outside it. Not finite
/// if the tet is flat.
glm::dvec4 barycentric(const TetMesh& mesh, const glm::uvec4& tet, const glm::dvec3& p);

/// A tet, and a point's coordinates in it.
struct TetPoint {
    std::uint32_t tet;
    glm::dvec4 weights;
};

/// A binary tree of boxes over tets, to find which of them contains a point.
class TetTree {
public:
    /// @param mesh as long-lived as the tree
    explicit TetTree(const TetMesh& mesh);

    /// The tet that contains `p`; of several the one in which it is farthest from a face, of these the first.
    /// A point on a face is inside in spite of rounding.
    std::optional<TetPoint> find(const glm::dvec3& p) const;

private:
    const TetMesh& mesh_;
    const BoxNodes tree_;
    double slack_ = 0.0;  // of boxes [m]
};

}  // namespace gelatin
