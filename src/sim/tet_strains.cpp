#include "sim/tet_strains.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "model/for_each_index.h"

namespace gelatin {
namespace {

template <class At>
glm::mat3 edges(const glm::uvec4& tet, const At& at) {
    const glm::vec3 a = at(tet.x);
    return {at(tet.y) - a, at(tet.z) - a, at(tet.w) - a};
}

// Von Mises' stress of Hooke's law for the principal Biot strains: what the colours of a picture show.
float stress_of(const glm::mat3& gradient, float shear_modulus) {
    const glm::mat3 square = glm::transpose(gradient) * gradient;
    Eigen::Matrix3d matrix;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) matrix(r, c) = static_cast<double>(square[c][r]);
    const Eigen::Vector3d squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>()
                                        .computeDirect(matrix, Eigen::EigenvaluesOnly)
                                        .eigenvalues();
    double stretches[3];
    for (int k = 0; k < 3; ++k) stretches[k] = std::sqrt(std::max(0.0, squares[k]));
    if (glm::determinant(gradient) < 0.0f) stretches[0] = -stretches[0];  // the smallest: it is inverted
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double difference = stretches[k] - stretches[(k + 1) % 3];
        sum += difference * difference;
    }
    return shear_modulus * static_cast<float>(std::sqrt(2.0 * sum));
}

}  // namespace

TetStrains::TetStrains(const Model& model) : tets_(model.tets), shear_moduli_(model.shear_moduli) {
    for (const glm::uvec4& tet : tets_)
        inverse_edges_.push_back(
            glm::inverse(edges(tet, [&](std::uint32_t n) { return glm::vec3(model.positions[n]); })));
}

TetStrains::Values TetStrains::find(std::span<const float> positions) const {
    Values values{std::vector<float>(9 * tets_.size()), std::vector<float>(tets_.size())};
    const auto at = [&](std::uint32_t n) {
        const std::size_t first = 3 * std::size_t{n};
        return glm::vec3(positions[first], positions[first + 1], positions[first + 2]);
    };
    for_each_index(tets_.size(), [&](std::size_t t) {
        const glm::mat3 gradient = edges(tets_[t], at) * inverse_edges_[t];
        const glm::mat3 strain = 0.5f * (glm::transpose(gradient) * gradient - glm::mat3(1.0f));
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                values.strains[9 * t + static_cast<std::size_t>(3 * r + c)] = strain[c][r];
        values.stresses[t] = stress_of(gradient, shear_moduli_[t]);
    });
    return values;
}

}  // namespace gelatin
