#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "mesh/lattice/face_tree.h"

namespace gelatin::lattice {

/// The generalized winding number of `faces` about `p`: the sum of the solid angles under which they are
/// seen, divided by 4 pi, positive from behind. Within a closed surface that winds outwards it is 1, outside
/// it is 0; holes make it vary smoothly. Jacobson et al. 2013, eq. 6; solid angles by Van Oosterom and
/// Strackee 1983.
double exact_winding_number(std::span<const Triangle> faces, const glm::dvec3& p);

/// The same in logarithmic time. Faces that are far from `p` relative to their extent are summarised by the
/// Taylor expansion of Barill et al. 2018, up to second order. The error is below 0.002, as
/// measured on closed, nested and loose faces (tests/mesh/lattice/solid_angles_test.cpp).
class SolidAngles {
public:
    /// @param tree must outlive this
    explicit SolidAngles(const FaceTree& tree);

    double operator()(const glm::dvec3& p) const;

private:
    /// Integrals over a node's faces, of their normal n and of x relative to the center.
    struct Moments {
        glm::dvec3 center{0.0};
        double near = 0.0;              // closer than this the expansion is not used
        glm::dvec3 normal{0.0};         // of n_i
        std::array<double, 6> first{};  // of n_i x_j, made symmetric: xx, yy, zz, xy, yz, zx
        glm::dvec3 trace{0.0};          // of x n.x + n x.x / 2
        std::array<double, 10>
            second{};  // of n_i x_j x_k, symmetric: xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz
    };
    static Moments moments_of(std::span<const Triangle> faces);
    static double expand(const Moments& moments, const glm::dvec3& d, double distance);

    const FaceTree& tree_;
    std::vector<Moments> moments_;  // shape [nodes of the tree]
};

}  // namespace gelatin::lattice
