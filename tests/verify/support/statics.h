#pragma once

#include <Eigen/Core>
#include <glm/vec3.hpp>
#include <vector>

#include "model/model.h"

namespace gelatin::test {

/// Where the nodes of a model come to rest under small loads: K u = f to first order in u, in double
/// precision, by conjugate gradients. What is not held may float: loads then must be in balance.
class Statics {
public:
    explicit Statics(const Model& model);

    /// Holds one coordinate of a node at the displacement `value` [m].
    void hold(std::uint32_t node, int axis, double value);
    /// Adds a force [N].
    void pull(std::uint32_t node, const Eigen::Vector3d& force);
    void solve();

    Eigen::Vector3d displacement(std::uint32_t node) const;  ///< [m]
    /// The force of springs and volume term on the node [N]: what holds it there gives the opposite.
    Eigen::Vector3d elastic_force(std::uint32_t node) const;
    /// The body's mean strain, from the displacements of its boundary (Gauss).
    Eigen::Matrix3d mean_strain() const;

private:
    Eigen::VectorXd stiffness_times(const Eigen::VectorXd& u) const;

    const Model& model_;
    std::vector<Eigen::Matrix<double, 3, 4>>
        volume_slopes_;  // of each tet by its corners [m^2]; none without volume term
    Eigen::VectorXd forces_, displacements_;
    Eigen::VectorXd free_;  // 1, and 0 where a coordinate is held
};

}  // namespace gelatin::test
