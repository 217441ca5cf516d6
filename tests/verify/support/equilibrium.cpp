#include "verify/support/equilibrium.h"

#include <Eigen/SparseCholesky>
#include <map>
#include <numbers>
#include <stdexcept>

#include "cpu/elasticity/neo_hookean.h"
#include "cpu/explicit/gather_forces.h"
#include "model/elasticity/neo_hookean.h"
#include "model/elasticity/node_tets.h"
#include "model/explicit/explicit_scheme.h"
#include "verify/support/coordinates.h"

namespace gelatin::test {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

cpu::Nodes<double> nodes_at(const Model& model, const Eigen::VectorXd& displacements) {
    cpu::Nodes<double> nodes;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const Eigen::Vector3d d = displacements.segment<3>(first_coordinate(n));
        nodes.positions.push_back(glm::dvec4(model.positions[n]) + glm::dvec4(d.x(), d.y(), d.z(), 0.0));
        nodes.velocities.emplace_back(0.0, 0.0, 0.0, static_cast<double>(model.velocities[n].w));
    }
    return nodes;
}

void add_block(std::uint32_t row, std::uint32_t column, const Eigen::Matrix3d& block, Triplets& triplets) {
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
            triplets.emplace_back(first_coordinate(row) + r, first_coordinate(column) + c, block(r, c));
    }
}

// Minus the derivative of `force(moved)` on a node by the place of the node `moved`.
template <class Force>
Eigen::Matrix3d derivative(const Force& force, cpu::Nodes<double>& nodes, std::uint32_t moved) {
    constexpr double kStep = 1e-7;  // [m]
    Eigen::Matrix3d block;
    for (int axis = 0; axis < 3; ++axis) {
        double& x = nodes.positions[moved][axis];
        const double middle = x;
        x = middle + kStep;
        const glm::dvec3 ahead = force();
        x = middle - kStep;
        const glm::dvec3 behind = force();
        x = middle;
        for (int r = 0; r < 3; ++r) block(r, axis) = (behind[r] - ahead[r]) / (2.0 * kStep);
    }
    return block;
}

// Of the volume term round each node [Pa]; empty without it.
std::vector<double> volume_stresses_at(const Model& model, const cpu::Nodes<double>& nodes) {
    std::vector<double> stresses;
    if (model.volume_term.is_empty()) return stresses;
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        stresses.push_back(cpu::volume_stress_round(model.volume_term, n, nodes.positions.data()));
    return stresses;
}

// With p the stresses, J the ratios and s the slopes of volumes v: p_t dds v_t of each tet, and of each node
// dp/dJ s s^T / V.
void add_volume_term(const Model& model, cpu::Nodes<double>& nodes, Triplets& triplets) {
    const std::vector<double> stresses = volume_stresses_at(model, nodes);
    if (stresses.empty()) return;
    std::vector<std::map<std::uint32_t, Eigen::Vector3d>> slopes(model.node_count());  // of v round nodes
    for (const glm::uvec4& tet : model.tets) {
        double stress = 0.0;
        for (int k = 0; k < 4; ++k) stress += 0.25 * stresses[tet[k]];
        for (int row = 0; row < 4; ++row) {
            const auto slope = [&] {
                const auto& others = kOppositeCorners[row];
                const glm::dvec3 a(nodes.positions[tet[others[0]]]);
                return glm::cross(glm::dvec3(nodes.positions[tet[others[1]]]) - a,
                                  glm::dvec3(nodes.positions[tet[others[2]]]) - a) /
                       6.0;
            };
            const glm::dvec3 s = slope();
            for (int k = 0; k < 4; ++k) {
                slopes[tet[k]].try_emplace(tet[row], Eigen::Vector3d::Zero()).first->second +=
                    0.25 * Eigen::Vector3d(s.x, s.y, s.z);
            }
            const auto force = [&] { return -stress * slope(); };
            for (int column = 0; column < 4; ++column)
                add_block(tet[row], tet[column], derivative(force, nodes, tet[column]), triplets);
        }
    }
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const glm::dvec2 rest(model.volume_term.nodes[n]);
        const double ratio = cpu::volume_ratio_round<double>(
            model.volume_term, n, [&](std::uint32_t k) { return glm::dvec3(nodes.positions[k]); });
        constexpr double kStep = 1e-4;
        const double stiffness =
            (cpu::volume_stress(ratio + kStep, rest.y) - cpu::volume_stress(ratio - kStep, rest.y)) /
            (2.0 * kStep * rest.x);
        for (const auto& [a, of_a] : slopes[n]) {
            for (const auto& [b, of_b] : slopes[n])
                add_block(a, b, stiffness * of_a * of_b.transpose(), triplets);
        }
    }
}

}  // namespace

Equilibrium::Equilibrium(const Model& model)
    : model_(model),
      loads_(Eigen::VectorXd::Zero(first_coordinate(model.node_count()))),
      displacements_(loads_),
      masses_(loads_),
      free_(Eigen::VectorXd::Ones(loads_.size())) {
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        masses_.segment<3>(first_coordinate(n)).setConstant(static_cast<double>(model.masses[n]));
        if (model.positions[n].w == 0.0f) free_.segment<3>(first_coordinate(n)).setZero();
    }
}

void Equilibrium::hold(std::uint32_t node, int axis, double value) {
    displacements_[first_coordinate(node) + axis] = value;
    free_[first_coordinate(node) + axis] = 0.0;
}

void Equilibrium::pull(std::uint32_t node, const Eigen::Vector3d& force) {
    loads_.segment<3>(first_coordinate(node)) += force;
}

void Equilibrium::pull_by_gravity(double share) {
    const glm::dvec3 g(model_.gravity);
    for (std::uint32_t n = 0; n < model_.node_count(); ++n)
        pull(n, share * static_cast<double>(model_.masses[n]) * Eigen::Vector3d(g.x, g.y, g.z));
}

void Equilibrium::solve() {
    constexpr int kMostSteps = 60;
    const auto unbalance = [&](const Eigen::VectorXd& u) {
        return Eigen::VectorXd((loads_ + elastic_forces(u)).cwiseProduct(free_));
    };
    Eigen::VectorXd residual = unbalance(displacements_);
    const double enough = 1e-9 * (residual.norm() + loads_.cwiseProduct(free_).norm());
    for (int k = 0; residual.norm() > enough; ++k) {
        const Solver solver(stiffness(displacements_));
        if (k == kMostSteps || solver.info() != Eigen::Success)
            throw std::runtime_error("no equilibrium was found");
        const Eigen::VectorXd way = solver.solve(residual);
        double share = 1.0;
        Eigen::VectorXd next = unbalance(displacements_ + way);
        // Halved until the forces along the displacement have not reversed to more than they were.
        while (std::abs(next.dot(way)) > residual.dot(way) && share > 1e-3) {
            share *= 0.5;
            next = unbalance(displacements_ + share * way);
        }
        displacements_ += share * way;
        residual = next;
    }
}

Eigen::Vector3d Equilibrium::displacement(std::uint32_t node) const {
    return displacements_.segment<3>(first_coordinate(node));
}

Eigen::Vector3d Equilibrium::elastic_force(std::uint32_t node) const {
    return elastic_forces(displacements_).segment<3>(first_coordinate(node));
}

// Inverse iteration: Rayleigh's quotient converges with the fourth power of the ratio of the two lowest
// frequencies, or at once where they are the same.
double Equilibrium::lowest_frequency() const {
    const Solver solver(stiffness(displacements_));
    Eigen::VectorXd mode = free_;
    double squared = 0.0;
    for (int k = 0; k < 12; ++k) {
        const Eigen::VectorXd load = masses_.cwiseProduct(mode).cwiseProduct(free_);
        const Eigen::VectorXd next = solver.solve(load);
        squared = next.dot(load) / next.dot(masses_.cwiseProduct(next));
        mode = next / next.norm();
    }
    return std::sqrt(squared) / (2.0 * std::numbers::pi);
}

Eigen::VectorXd Equilibrium::elastic_forces(const Eigen::VectorXd& displacements) const {
    const cpu::Nodes<double> nodes = nodes_at(model_, displacements);
    cpu::Nodes<double> out = nodes, sums;
    auto pass = cpu::make_pass(model_, explicit_scheme(SolverKind::semi_implicit_euler), 0, 1.0, nodes, nodes,
                               out, sums);
    const std::vector<double> volume_stresses = volume_stresses_at(model_, nodes);
    if (!volume_stresses.empty()) pass.volume_stresses = volume_stresses.data();
    Eigen::VectorXd forces(displacements.size());
    for (std::uint32_t n = 0; n < model_.node_count(); ++n) {
        const glm::dvec3 f = cpu::gather_forces(pass, n);
        forces.segment<3>(first_coordinate(n)) = Eigen::Vector3d(f.x, f.y, f.z);
    }
    return forces;
}

Eigen::SparseMatrix<double> Equilibrium::stiffness(const Eigen::VectorXd& displacements) const {
    cpu::Nodes<double> nodes = nodes_at(model_, displacements);
    Triplets triplets;
    for (const NeoHookeanTet& tet : model_.neo_hookean_tets) {
        const glm::uvec4 corners = nodes_of(tet);
        for (std::uint32_t row = 0; row < 4; ++row) {
            const auto force = [&] {
                return cpu::neo_hookean_force(tet, row, nodes.positions.data(), nodes.velocities.data());
            };
            for (int column = 0; column < 4; ++column) {
                add_block(corners[static_cast<int>(row)], corners[column],
                          derivative(force, nodes, corners[column]), triplets);
            }
        }
    }
    for (const Spring& spring : model_.springs) {
        const auto force = [&] {
            return cpu::spring_force(nodes.positions.data(), nodes.velocities.data(), spring.i, spring.j,
                                     spring.rest_length, spring.stiffness);
        };
        const Eigen::Matrix3d block = derivative(force, nodes, spring.i);
        add_block(spring.i, spring.i, block, triplets);
        add_block(spring.j, spring.j, block, triplets);
        add_block(spring.i, spring.j, -block, triplets);
        add_block(spring.j, spring.i, -block, triplets);
    }
    add_volume_term(model_, nodes, triplets);
    // Constrained coordinates have no residual.
    Triplets kept;
    for (const auto& entry : triplets) {
        if (free_[entry.row()] > 0.0 && free_[entry.col()] > 0.0) kept.push_back(entry);
    }
    for (Eigen::Index k = 0; k < free_.size(); ++k) {
        if (free_[k] == 0.0) kept.emplace_back(k, k, 1.0);
    }
    Eigen::SparseMatrix<double> matrix(free_.size(), free_.size());
    matrix.setFromTriplets(kept.begin(), kept.end());
    return matrix;
}

}  // namespace gelatin::test
