#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "mesh/lattice/face_columns.h"
#include "mesh/lattice/face_tree.h"
#include "mesh/lattice/solid_angles.h"
#include "mesh/surface_mesh.h"

namespace gelatin::lattice {

/// The generalized winding numbers of a surface (solid_angles.h), whatever the shape of its faces.
///
/// The surface is closed by caps (caps.h). What it is together with them winds around a point as often as
/// crossings along a ray say, and the caps alone by their solid angles. So a closed surface has integers.
class WindingNumbers {
public:
    explicit WindingNumbers(const SurfaceMesh& surface);
    WindingNumbers(const WindingNumbers&) = delete;
    WindingNumbers& operator=(const WindingNumbers&) = delete;

    double operator()(const glm::dvec3& p) const {
        return closed_.winding_number(p) - (is_closed() ? 0.0 : of_caps_(p));
    }

    /// Then the numbers change only where faces are.
    bool is_closed() const { return caps_.faces().empty(); }

private:
    WindingNumbers(const SurfaceMesh& surface, const SurfaceMesh& caps);

    FaceTree caps_;
    SolidAngles of_caps_;
    FaceColumns closed_;
};

}  // namespace gelatin::lattice
