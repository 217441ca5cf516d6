#include "support/eigen_modes.h"

#include <Eigen/Eigenvalues>

namespace gelatin::test {

EigenModes eigen_modes(const Eigen::MatrixXd& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace gelatin::test
