#pragma once

#include <Eigen/Core>

namespace gelatin::test {

struct EigenModes {
    Eigen::VectorXd values;   ///< ascending
    Eigen::MatrixXd vectors;  ///< a column each
};

/// Of a symmetric matrix. One function for all tests, since Eigen's solver takes seconds to compile.
EigenModes eigen_modes(const Eigen::MatrixXd& symmetric);

}  // namespace gelatin::test
