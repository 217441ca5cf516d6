#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/model.h"

namespace gelatin::test {

/// The objective whose minimum is a step of implicit Euler from a model's start, in double precision and
/// without damping and colliders: inertia, springs and the volume term, written apart from what it tests.
class ImplicitEuler {
public:
    ImplicitEuler(const Model& model, double step);

    /// Nodes' coordinates one behind the other [m], shape [3 nodes].
    Eigen::VectorXd start() const;
    double value(const Eigen::VectorXd& x) const;              ///< [J]
    Eigen::VectorXd gradient(const Eigen::VectorXd& x) const;  ///< [N]; zero for pinned nodes
    /// Newton's method with a line search, until the gradient is 1e-11 of that at the start.
    /// @throws std::runtime_error if it does not get there
    Eigen::VectorXd minimum() const;

private:
    struct Volumes {
        std::vector<double> nodes;                        // over those at rest
        std::vector<Eigen::Matrix<double, 3, 4>> slopes;  // of each tet's volume by its corners [m^2]
    };

    Volumes volumes(const Eigen::VectorXd& x) const;
    Eigen::VectorXd direction(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient) const;

    const Model& model_;
    double step_;
    Eigen::VectorXd targets_;
};

}  // namespace gelatin::test
