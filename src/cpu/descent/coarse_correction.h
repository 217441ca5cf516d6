#pragma once

#include <glm/mat3x3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "cpu/nodes.h"
#include "model/descent/coarse_basis.h"
#include "model/descent/coarse_matrix.h"
#include "model/model.h"

namespace gelatin::cpu {

/// The coarse level of block descent (model/descent/coarse_basis.h): where all nodes go at once along the
/// motions of clusters, by one Newton step whose matrix is that of the bodies at rest, rotated as each
/// cluster is now (docs/block-descent.md). Without a factorisation in a step, and the same bits for any
/// number of threads.
template <class Real>
class CoarseCorrection {
public:
    explicit CoarseCorrection(std::shared_ptr<const Model> model);

    /// Of the object's nodes.
    bool moves(std::size_t object) const { return basis_.objects[object].count > 0; }
    double length(std::size_t object) const { return basis_.lengths[object]; }  ///< [m]
    bool is_empty() const { return basis_.cluster_count() == 0; }

    /// Finds the clusters' orientations. Once a step of `step` seconds, before find_displacements.
    void begin(Real step, std::span<const Vec4<Real>> positions);

    /// Where nodes go that `forces` act on [N]; not written for bodies without clusters.
    /// @param forces, displacements shape [nodes], [m]
    void find_displacements(std::span<const Vec4<Real>> positions, std::span<const Vec3<Real>> forces,
                            std::span<Vec3<Real>> displacements);

private:
    struct Cluster {
        Vec3<Real> middle{0};  // [m]
        glm::mat<3, 3, Real> orientation{1};
        Vec3<Real> force{0}, moment{0};          // [N], [N m]; in the cluster's orientation at rest
        Vec3<Real> translation{0}, rotation{0};  // [m], [radians]
    };

    void gather(std::uint32_t index, std::span<const Vec4<Real>> positions,
                std::span<const Vec3<Real>> forces);
    void solve(std::size_t object);

    std::shared_ptr<const Model> model_;
    CoarseBasis basis_;
    std::vector<CoarseMatrices> matrices_;
    std::vector<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>> inverses_;  // of steps of step_ seconds
    Real step_ = Real(0);
    std::vector<Cluster> clusters_;
};

}  // namespace gelatin::cpu
