#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "mesh/lattice/face_tree.h"
#include "mesh/lattice/surface_pieces.h"
#include "mesh/lattice/winding_numbers.h"
#include "mesh/surface_mesh.h"

namespace gelatin::lattice {

/// How far it is from a face to the opposite side.
struct Thickness {
    /// Of where the face is the boundary and the opposite side is nearly parallel to it. Edges and tips of
    /// wedges are not thin.
    std::optional<double> value = {};
    bool is_final = true;  ///< a search with a larger limit finds the same
};

/// What a surface encloses: the points with a winding number above 1/2. Defined for any faces, also those
/// that are open, cross each other or are there twice.
class EnclosedSpace {
public:
    explicit EnclosedSpace(const SurfaceMesh& surface);
    EnclosedSpace(const EnclosedSpace&) = delete;
    EnclosedSpace& operator=(const EnclosedSpace&) = delete;

    const FaceTree& tree() const { return tree_; }
    const SurfacePieces& pieces() const { return pieces_; }
    std::uint32_t piece_of(std::uint32_t face) const { return pieces_.of_face[tree_.sources()[face]]; }
    bool contains(const glm::dvec3& p) const { return winding_(p) > 0.5; }

    /// A point of the boundary between `inside`, which this contains, and `outside`, which it does not. It
    /// lies on a face, to rounding, where a face is the boundary.
    glm::dvec3 find_boundary(const glm::dvec3& inside, const glm::dvec3& outside) const;

    /// How thick this is behind a face, from its centre against its normal, up to `limit`.
    Thickness find_thickness(const Triangle& face, double limit) const;

private:
    FaceTree tree_;
    SurfacePieces pieces_;
    WindingNumbers winding_;
};

}  // namespace gelatin::lattice
