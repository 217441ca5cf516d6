#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "model/model.h"

namespace gelatin::test {

/// Where the nodes of a model come to rest under loads of any size, and how they swing about it: Newton's
/// method with direct solutions, in double precision. Forces are those of the solver (cpu::gather_forces),
/// the tangent stiffness their derivative. Pinned nodes stay.
class Equilibrium {
public:
    explicit Equilibrium(const Model& model);

    /// Holds one coordinate of a node at the displacement `value` [m].
    void hold(std::uint32_t node, int axis, double value);
    /// Adds a force [N].
    void pull(std::uint32_t node, const Eigen::Vector3d& force);
    /// Adds the weight of all nodes under the model's gravity, times `share`.
    void pull_by_gravity(double share = 1.0);
    /// Forces on coordinates that may move are zero to 1e-9 of the loads, or to rounding, afterwards.
    /// @throws std::runtime_error if they do not get there
    void solve();

    Eigen::Vector3d displacement(std::uint32_t node) const;  ///< [m]
    /// The elastic force on the node [N]: what holds it there gives the opposite.
    Eigen::Vector3d elastic_force(std::uint32_t node) const;
    /// Of small free oscillations about the shape that `solve` found [Hz].
    double lowest_frequency() const;

private:
    Eigen::VectorXd elastic_forces(const Eigen::VectorXd& displacements) const;
    Eigen::SparseMatrix<double> stiffness(const Eigen::VectorXd& displacements) const;

    const Model& model_;
    Eigen::VectorXd loads_, displacements_, masses_;
    Eigen::VectorXd free_;  // 1, and 0 where a coordinate is held
};

}  // namespace gelatin::test
