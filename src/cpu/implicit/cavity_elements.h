#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// The gas of cavities in a step, linearised where it begins. The volume that a hollow encloses is
///   V(x + d) = V + g . d + d . H d / 2 + ...,
///   g_a = sum of b x c / 6,  (H d)_a = sum of (d_b x c + b x d_c) / 6  over its faces (a, b, c).
/// Gas of pressure p adds p g to forces f, and to K, as ElasticSystem has it,
///   k g g^T - p H,  k = -dp/dV.
/// Blocks of H on the diagonal are 0.
template <class Real>
class CavityElements {
public:
    explicit CavityElements(std::shared_ptr<const Model> model);

    /// @param positions shape [nodes] @param drives of cavities (Cavity::drive_at)
    void linearise(std::span<const Vec4<Real>> positions, std::span<const double> drives);
    /// Of each body, after it. H counts by as much as elements resist rotations, so that both together do
    /// not, and until then it does not count.
    /// @param resistance sum of w . K w over the rotations w about three axes, of 1 rad each [J]
    void balance_rotations(const ModelObject& body, double resistance);
    /// What they add, once linearised. @param diagonal 3 x 3 blocks of K
    void add(std::span<Vec3<Real>> forces, std::span<SymmetricMatrix<Real>> diagonal) const;

    /// To be called for each d and body, before its products. @param displacements d, shape [nodes]
    void begin_product(const ModelObject& body, std::span<const Vec4<Real>> displacements);
    /// Adds what they add to K d of some nodes. @param product shape [nodes]
    void multiply(const Range& nodes, std::span<const Vec4<Real>> displacements,
                  std::span<Vec3<Real>> product) const;

private:
    // A node of a hollow's surface, with all edges that begin there.
    struct Corner {
        std::uint32_t node, cavity;
        Range edges{0, 0};
    };
    // To `other`, with the third nodes of both its faces, (node, other, next) and (other, node, previous).
    struct Edge {
        std::uint32_t other, next, previous;
    };

    void append_corners(std::uint32_t cavity);

    std::shared_ptr<const Model> model_;
    std::vector<Corner> corners_;                          // by node, then by cavity
    std::vector<std::vector<std::uint32_t>> of_cavities_;  // their corners
    std::vector<Edge> edges_;
    // Of cavities: V [m^3], p [Pa], k [Pa/m^3], the part of p that H counts by [Pa], k g . d [Pa]; of
    // corners: g [m^2]; of edges: (next - previous) / 6 [m].
    std::vector<double> volumes_;
    std::vector<Real> pressures_, stiffnesses_, curvatures_, values_;
    std::vector<Vec3<Real>> gradients_, arms_;
};

}  // namespace gelatin::cpu
