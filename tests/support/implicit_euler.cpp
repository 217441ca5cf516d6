#include "support/implicit_euler.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/elasticity/neo_hookean.h"
#include "model/elasticity/node_tets.h"
#include "support/eigen_modes.h"

namespace gelatin::test {
namespace {

Eigen::Vector3d to_eigen(const glm::vec4& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Eigen::Index at(std::uint32_t node) {
    return 3 * static_cast<Eigen::Index>(node);
}

// phi of the volume term, and its slope, over kappa.
double potential(double ratio, double kappa) {
    const double u = ratio - 1.0;
    if (kappa >= 0.0) return 0.5 * u * u;
    return (1.0 - std::pow(std::max(1.0 - 4.0 * u * u, 0.0), 3)) / 24.0;
}
double slope_of_potential(double ratio, double kappa) {
    const double u = ratio - 1.0;
    return kappa >= 0.0 ? u : u * std::pow(std::max(1.0 - 4.0 * u * u, 0.0), 2);
}

// A neo-Hookean tet where its nodes are. The columns of matrices follow each other in vectors of nine.
struct ElasticTet {
    using Vector9 = Eigen::Matrix<double, 9, 1>;
    using Matrix9 = Eigen::Matrix<double, 9, 9>;

    Eigen::Vector4i nodes;
    Eigen::Matrix<double, 4, 3> gradients;  // of the corners' shape functions, a row each
    double volume, mu, lambda;
    Eigen::Matrix3d f, cofactor;
    double squares, dilation;

    ElasticTet(const NeoHookeanTet& tet, const Eigen::VectorXd& x)
        : nodes(tet.node_0, tet.node_1, tet.node_2, tet.node_3),
          volume(static_cast<double>(tet.gradient_1.w)),
          mu(static_cast<double>(tet.gradient_2.w)),
          lambda(static_cast<double>(tet.gradient_3.w)) {
        gradients.row(1) = to_eigen(tet.gradient_1);
        gradients.row(2) = to_eigen(tet.gradient_2);
        gradients.row(3) = to_eigen(tet.gradient_3);
        gradients.row(0) = -gradients.bottomRows<3>().colwise().sum();
        f.setZero();
        for (int k = 0; k < 4; ++k) f += x.segment<3>(3 * nodes[k]) * gradients.row(k);
        cofactor << f.col(1).cross(f.col(2)), f.col(2).cross(f.col(0)), f.col(0).cross(f.col(1));
        squares = f.squaredNorm();
        dilation = f.determinant() - 1.0;
    }

    double energy() const {
        return volume * (0.5 * mu * (squares - 3.0 - std::log(0.25 * (squares + 1.0))) -
                         0.75 * mu * dilation + 0.5 * lambda * dilation * dilation);
    }
    double pressure() const { return lambda * dilation - 0.75 * mu; }
    Eigen::Matrix3d stress() const {
        return volume * (mu * squares / (squares + 1.0) * f + pressure() * cofactor);
    }
    // By f, without what is negative (J. Teran et al.: Robust Quasistatic Finite Elements, 2005).
    Matrix9 stiffness() const {
        const Vector9 along = f.reshaped(), growing = cofactor.reshaped();
        Matrix9 matrix = mu * squares / (squares + 1.0) * Matrix9::Identity();
        matrix += 2.0 * mu / std::pow(squares + 1.0, 2) * along * along.transpose();
        matrix += lambda * growing * growing.transpose();
        for (int k = 0; k < 3; ++k) {  // how columns of the cofactor turn with the other two of f
            const Eigen::Vector3d v = f.col(k);
            Eigen::Matrix3d cross;
            cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
            const int next = 3 * ((k + 1) % 3), last = 3 * ((k + 2) % 3);
            matrix.block<3, 3>(next, last) -= pressure() * cross;
            matrix.block<3, 3>(last, next) += pressure() * cross;
        }
        const EigenModes modes = eigen_modes(matrix);
        return volume * modes.vectors * modes.values.cwiseMax(0.0).asDiagonal() * modes.vectors.transpose();
    }
    // How f changes with a corner's place.
    Eigen::Matrix<double, 9, 3> slope(int corner) const {
        Eigen::Matrix<double, 9, 3> result;
        for (int axis = 0; axis < 3; ++axis)
            result.middleRows<3>(3 * axis) = gradients(corner, axis) * Eigen::Matrix3d::Identity();
        return result;
    }
};

}  // namespace

ImplicitEuler::ImplicitEuler(const Model& model, double step)
    : model_(model), step_(step), targets_(at(model.node_count())) {
    const Eigen::Vector3d gravity = to_eigen(glm::vec4(model.gravity, 0.0f));
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        targets_.segment<3>(at(n)) = to_eigen(model.positions[n]);
        if (model.positions[n].w > 0.0f)
            targets_.segment<3>(at(n)) += step * (to_eigen(model.velocities[n]) + step * gravity);
    }
}

Eigen::VectorXd ImplicitEuler::start() const {
    Eigen::VectorXd x(targets_.size());
    for (std::uint32_t n = 0; n < model_.node_count(); ++n)
        x.segment<3>(at(n)) = to_eigen(model_.positions[n]);
    return x;
}

ImplicitEuler::Volumes ImplicitEuler::volumes(const Eigen::VectorXd& x) const {
    Volumes result;
    result.nodes.assign(model_.node_count(), 0.0);
    for (const glm::uvec4& tet : model_.tets) {
        Eigen::Matrix<double, 3, 4> corners, slopes;
        for (int k = 0; k < 4; ++k) corners.col(k) = x.segment<3>(at(tet[k]));
        for (int k = 0; k < 4; ++k) {
            const auto& other = kOppositeCorners[k];
            const Eigen::Vector3d u = corners.col(other[1]) - corners.col(other[0]),
                                  v = corners.col(other[2]) - corners.col(other[0]);
            slopes.col(k) = u.cross(v) / 6.0;
        }
        const double volume = slopes.col(0).dot(corners.col(0) - corners.col(kOppositeCorners[0][0]));
        for (int k = 0; k < 4; ++k) result.nodes[tet[k]] += 0.25 * volume;
        result.slopes.push_back(slopes);
    }
    for (std::size_t n = 0; n < result.nodes.size(); ++n)
        result.nodes[n] /= static_cast<double>(model_.volume_term.nodes[n].x);
    return result;
}

double ImplicitEuler::value(const Eigen::VectorXd& x) const {
    double sum = 0.0;
    for (std::uint32_t n = 0; n < model_.node_count(); ++n) {
        if (model_.positions[n].w == 0.0f) continue;
        const double mass = 1.0 / static_cast<double>(model_.positions[n].w);
        sum += 0.5 * mass / (step_ * step_) * (x - targets_).segment<3>(at(n)).squaredNorm();
    }
    for (const Spring& s : model_.springs) {
        const double stretch =
            (x.segment<3>(at(s.j)) - x.segment<3>(at(s.i))).norm() - static_cast<double>(s.rest_length);
        sum += 0.5 * static_cast<double>(s.stiffness) * stretch * stretch;
    }
    for (const NeoHookeanTet& tet : model_.neo_hookean_tets) sum += ElasticTet(tet, x).energy();
    if (model_.volume_term.is_empty()) return sum;
    const Volumes now = volumes(x);
    for (std::size_t n = 0; n < now.nodes.size(); ++n) {
        const glm::dvec2 rest(model_.volume_term.nodes[n]);
        sum += rest.x * rest.y * potential(now.nodes[n], rest.y);
    }
    return sum;
}

Eigen::VectorXd ImplicitEuler::gradient(const Eigen::VectorXd& x) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(x.size());
    for (const Spring& s : model_.springs) {
        const Eigen::Vector3d apart = x.segment<3>(at(s.j)) - x.segment<3>(at(s.i));
        const double length = apart.norm();
        const Eigen::Vector3d force =
            static_cast<double>(s.stiffness) * (length - static_cast<double>(s.rest_length)) / length * apart;
        result.segment<3>(at(s.i)) -= force;
        result.segment<3>(at(s.j)) += force;
    }
    for (const NeoHookeanTet& packed : model_.neo_hookean_tets) {
        const ElasticTet tet(packed, x);
        for (int k = 0; k < 4; ++k)
            result.segment<3>(3 * tet.nodes[k]) += tet.stress() * tet.gradients.row(k).transpose();
    }
    if (!model_.volume_term.is_empty()) {
        const Volumes now = volumes(x);
        for (std::size_t t = 0; t < model_.tets.size(); ++t) {
            const glm::uvec4& tet = model_.tets[t];
            double pressure = 0.0;
            for (int k = 0; k < 4; ++k) {
                const auto kappa = static_cast<double>(model_.volume_term.nodes[tet[k]].y);
                pressure += 0.25 * kappa * slope_of_potential(now.nodes[tet[k]], kappa);
            }
            for (int k = 0; k < 4; ++k) result.segment<3>(at(tet[k])) += pressure * now.slopes[t].col(k);
        }
    }
    for (std::uint32_t n = 0; n < model_.node_count(); ++n) {
        if (model_.positions[n].w == 0.0f) {
            result.segment<3>(at(n)).setZero();
        } else {
            const double mass = 1.0 / static_cast<double>(model_.positions[n].w);
            result.segment<3>(at(n)) += mass / (step_ * step_) * (x - targets_).segment<3>(at(n));
        }
    }
    return result;
}

// By a positive definite approximation of the Hessian: springs without what is negative across them, the
// volume term without the second derivatives of volumes.
Eigen::VectorXd ImplicitEuler::direction(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient) const {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](std::uint32_t row, std::uint32_t column, const Eigen::Matrix3d& block) {
        const bool is_pinned = model_.positions[row].w == 0.0f || model_.positions[column].w == 0.0f;
        if (is_pinned && row != column) return;
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) entries.emplace_back(at(row) + r, at(column) + c, block(r, c));
        }
    };
    for (std::uint32_t n = 0; n < model_.node_count(); ++n) {
        const double inverse_mass = static_cast<double>(model_.positions[n].w);
        add(n, n,
            Eigen::Matrix3d::Identity() * (inverse_mass > 0.0 ? 1.0 / (inverse_mass * step_ * step_) : 1.0));
    }
    for (const Spring& s : model_.springs) {
        const Eigen::Vector3d apart = x.segment<3>(at(s.j)) - x.segment<3>(at(s.i));
        const double length = apart.norm(), k = static_cast<double>(s.stiffness);
        const Eigen::Matrix3d along = apart * apart.transpose() / (length * length);
        const double across = std::max(1.0 - static_cast<double>(s.rest_length) / length, 0.0);
        const Eigen::Matrix3d block = k * (along + across * (Eigen::Matrix3d::Identity() - along));
        add(s.i, s.i, block);
        add(s.j, s.j, block);
        add(s.i, s.j, -block);
        add(s.j, s.i, -block);
    }
    for (const NeoHookeanTet& packed : model_.neo_hookean_tets) {
        const ElasticTet tet(packed, x);
        const ElasticTet::Matrix9 stiffness = tet.stiffness();
        for (int a = 0; a < 4; ++a) {
            for (int b = 0; b < 4; ++b) {
                add(nodes_of(packed)[a], nodes_of(packed)[b],
                    tet.slope(a).transpose() * stiffness * tet.slope(b));
            }
        }
    }
    if (!model_.volume_term.is_empty()) {
        const Volumes now = volumes(x);
        const NodeTets tets = make_node_tets(model_.node_count(), model_.tets);
        for (std::uint32_t n = 0; n < model_.node_count(); ++n) {
            std::vector<std::pair<std::uint32_t, Eigen::Vector3d>> slopes;  // of the node's volume
            for (std::uint32_t e = tets.starts[n]; e < tets.starts[n + 1]; ++e) {
                const std::uint32_t t = tets.entries[e] / 4;
                for (int k = 0; k < 4; ++k)
                    slopes.emplace_back(model_.tets[t][k], 0.25 * now.slopes[t].col(k));
            }
            const glm::dvec2 rest(model_.volume_term.nodes[n]);
            for (const auto& [a, slope_a] : slopes) {
                for (const auto& [b, slope_b] : slopes)
                    add(a, b, std::max(rest.y, 0.0) / rest.x * slope_a * slope_b.transpose());
            }
        }
    }
    Eigen::SparseMatrix<double> hessian(x.size(), x.size());
    hessian.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(hessian).solve(-gradient);
}

Eigen::VectorXd ImplicitEuler::minimum() const {
    Eigen::VectorXd x = start();
    Eigen::VectorXd slope = gradient(x);
    const double enough = 1e-11 * slope.norm();
    double terms = 0.0;  // of what tets' energy is the difference [J]
    for (const NeoHookeanTet& tet : model_.neo_hookean_tets)
        terms += static_cast<double>(tet.gradient_1.w * tet.gradient_2.w);
    for (int i = 0; slope.norm() > enough; ++i) {
        if (i > 500) throw std::runtime_error("Newton's method does not converge");
        const Eigen::VectorXd descent = direction(x, slope);
        const double here = value(x), promised = slope.dot(descent),
                     rounding = 1e-14 * (std::abs(here) + terms);
        double length = 1.0;
        while (length > 1e-6 && value(x + length * descent) > here + 1e-4 * length * promised + rounding)
            length *= 0.5;
        x += length * descent;
        slope = gradient(x);
    }
    return x;
}

}  // namespace gelatin::test
