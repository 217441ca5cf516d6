#include "cpu/implicit/rigid_rows.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// (s, w) -> s + w x r, as a matrix of three rows.
Eigen::Matrix<double, 3, 6> motion_at(const glm::dvec3& r) {
    Eigen::Matrix<double, 3, 6> j;
    j << 1, 0, 0, 0, r.z, -r.y,  //
        0, 1, 0, -r.z, 0, r.x,   //
        0, 0, 1, r.y, -r.x, 0;
    return j;
}

Eigen::Matrix3d matrix_of(const SymmetricMatrix<double>& h) {
    Eigen::Matrix3d m;
    m << h.diagonal.x, h.beside.z, h.beside.y,  //
        h.beside.z, h.diagonal.y, h.beside.x,   //
        h.beside.y, h.beside.x, h.diagonal.z;
    return m;
}

}  // namespace

template <class Real>
RigidRows<Real>::RigidRows(const RigidLevel<Real>& level, std::vector<std::uint32_t> bodies,
                           std::span<const ContactRow<Real>> rows)
    : level_(level), bodies_(std::move(bodies)), touches_(rows.size()), pair_of_row_(rows.size()) {
    for_each_index(rows.size(), [&](std::size_t r) {
        const ContactRow<Real>& row = rows[r];
        Touch& touch = touches_[r];
        for (std::size_t side = 0; side < 2; ++side) {
            touch.bodies[side] = place_of(side == 0 ? row.object : row.other);
            if (touch.bodies[side] == kNoNode) continue;
            for (std::uint32_t k = 0; k < row.count; ++k)
                if ((side == 0) == (row.weights[k] < Real(0)))
                    touch.arms[side] +=
                        std::abs(static_cast<double>(row.weights[k])) * glm::dvec3(level_.arm(row.nodes[k]));
        }
    });
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const auto& [first, second] = touches_[r].bodies;
        const auto [at, is_new] =
            numbers.try_emplace({first, second}, static_cast<std::uint32_t>(pairs_.size()));
        if (is_new) pairs_.push_back({.bodies = {first, second}, .entries = {0, 0}});
        pair_of_row_[r] = at->second;
        ++pairs_[at->second].entries.count;
    }
    std::uint32_t entries = 0;
    for (Pair& pair : pairs_) {
        pair.entries.first = entries;
        entries += std::exchange(pair.entries.count, 0u);
    }
    pair_rows_.resize(rows.size());
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        Range& own = pairs_[pair_of_row_[r]].entries;
        pair_rows_[own.first + own.count++] = r;
    }
    if (!pairs_.empty()) find_pattern();
}

template <class Real>
std::uint32_t RigidRows<Real>::place_of(std::uint32_t object) const {
    const auto at = std::lower_bound(bodies_.begin(), bodies_.end(), object);
    return at != bodies_.end() && *at == object ? static_cast<std::uint32_t>(at - bodies_.begin()) : kNoNode;
}

// Blocks of 6 x 6, those of a column in the order of their rows, the one on the diagonal first.
template <class Real>
void RigidRows<Real>::find_pattern() {
    std::vector<std::vector<std::uint32_t>> columns(bodies_.size());
    const auto is_coupling = [](const Pair& pair) {
        const auto& [a, b] = pair.bodies;
        return a != kNoNode && b != kNoNode && a != b;
    };
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) columns[b].push_back(b);
    for (const Pair& pair : pairs_)
        if (is_coupling(pair))
            columns[std::min(pair.bodies[0], pair.bodies[1])].push_back(
                std::max(pair.bodies[0], pair.bodies[1]));
    const auto size = static_cast<Eigen::Index>(6 * columns.size());
    std::size_t blocks = 0;
    for (std::vector<std::uint32_t>& column : columns) {
        std::sort(column.begin(), column.end());
        column.erase(std::unique(column.begin(), column.end()), column.end());
        blocks += column.size();
    }
    matrix_.resize(size, size);
    matrix_.resizeNonZeros(static_cast<Eigen::Index>(36 * blocks));
    int *end = matrix_.outerIndexPtr(), *row = matrix_.innerIndexPtr();
    *end = 0;
    for (const std::vector<std::uint32_t>& column : columns)
        for (int j = 0; j < 6; ++j, ++end) {
            for (const std::uint32_t block : column)
                for (int i = 0; i < 6; ++i) *row++ = 6 * static_cast<int>(block) + i;
            end[1] = end[0] + 6 * static_cast<int>(column.size());
        }
    std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
    factors_.analyzePattern(matrix_);
    places_.resize(pairs_.size());
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        if (!is_coupling(pairs_[p])) continue;
        const auto [low, high] = std::minmax(pairs_[p].bodies[0], pairs_[p].bodies[1]);
        const auto& column = columns[low];
        places_[p] =
            static_cast<std::uint32_t>(std::lower_bound(column.begin(), column.end(), high) - column.begin());
    }
}

template <class Real>
void RigidRows<Real>::factorise(std::span<const RowTangent<Real>> tangents) {
    if (pairs_.empty()) return;
    for_each_index(0, pairs_.size(), 1, [&](std::size_t p) {
        Pair& pair = pairs_[p];
        for (MotionMatrix& block : pair.blocks) block.setZero();
        const bool is_swapped = pair.bodies[0] < pair.bodies[1];
        for (std::uint32_t e = pair.entries.first; e < pair.entries.end(); ++e) {
            const Touch& touch = touches_[pair_rows_[e]];
            const SymmetricMatrix<Real>& h = tangents[pair_rows_[e]].stiffness;
            if (!(h.diagonal.x + h.diagonal.y + h.diagonal.z > Real(0))) continue;
            const Eigen::Matrix3d stiffness = matrix_of({glm::dvec3(h.diagonal), glm::dvec3(h.beside)});
            const Eigen::Matrix<double, 3, 6> first = -motion_at(touch.arms[0]),
                                              second = motion_at(touch.arms[1]);
            const Eigen::Matrix<double, 3, 6> pull = stiffness * first, push = stiffness * second;
            if (pair.bodies[0] != kNoNode) pair.blocks[0].noalias() += first.transpose() * pull;
            if (pair.bodies[1] != kNoNode) pair.blocks[1].noalias() += second.transpose() * push;
            if (pair.bodies[0] == kNoNode || pair.bodies[1] == kNoNode) continue;
            if (is_swapped) {
                pair.blocks[2].noalias() += second.transpose() * pull;
            } else {
                pair.blocks[2].noalias() += first.transpose() * push;
            }
        }
    });
    const auto add = [&](const MotionMatrix& block, std::uint32_t column, std::uint32_t place) {
        for (int j = 0; j < 6; ++j) {
            double* values = matrix_.valuePtr() +
                             matrix_.outerIndexPtr()[6 * column + static_cast<std::uint32_t>(j)] + 6 * place;
            for (int i = 0; i < 6; ++i) values[i] += block(i, j);
        }
    };
    std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) add(level_.matrix(bodies_[b]), b, 0);
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const Pair& pair = pairs_[p];
        const auto& [first, second] = pair.bodies;
        if (first != kNoNode) add(pair.blocks[0], first, 0);
        if (second != kNoNode) add(pair.blocks[1], second, 0);
        if (first == kNoNode || second == kNoNode) continue;
        if (first == second) {
            add(pair.blocks[2] + pair.blocks[2].transpose(), first, 0);
        } else {
            add(pair.blocks[2], std::min(first, second), places_[p]);
        }
    }
    factors_.factorize(matrix_);
}

template <class Real>
void RigidRows<Real>::add_rows(std::span<const Vec3<Real>> forces, std::span<Motion> sums) const {
    std::vector<std::array<Motion, 2>> by_pair(pairs_.size());
    for_each_index(0, pairs_.size(), 1, [&](std::size_t p) {
        glm::dvec3 force(0.0), moments[2] = {glm::dvec3(0.0), glm::dvec3(0.0)};
        const Range& entries = pairs_[p].entries;
        for (std::uint32_t e = entries.first; e < entries.end(); ++e) {
            const Touch& touch = touches_[pair_rows_[e]];
            const glm::dvec3 f(forces[pair_rows_[e]]);
            force += f;
            for (std::size_t side = 0; side < 2; ++side) moments[side] += glm::cross(touch.arms[side], f);
        }
        by_pair[p] = {-motion(force, moments[0]), motion(force, moments[1])};
    });
    for (std::size_t p = 0; p < pairs_.size(); ++p)
        for (std::size_t side = 0; side < 2; ++side)
            if (pairs_[p].bodies[side] != kNoNode) sums[pairs_[p].bodies[side]] += by_pair[p][side];
}

template <class Real>
std::vector<Motion> RigidRows<Real>::resistance(std::span<const Motion> motions) const {
    std::vector<Motion> forces(motions.size());
    for (std::size_t b = 0; b < motions.size(); ++b) forces[b] = level_.matrix(bodies_[b]) * motions[b];
    return forces;
}

template <class Real>
Vec3<Real> RigidRows<Real>::relative(std::size_t row, std::span<const Motion> motions) const {
    const Touch& touch = touches_[row];
    glm::dvec3 s(0.0);
    for (std::size_t side = 0; side < 2; ++side) {
        if (touch.bodies[side] == kNoNode) continue;
        const Motion& m = motions[touch.bodies[side]];
        const glm::dvec3 d =
            glm::dvec3(m(0), m(1), m(2)) + glm::cross(glm::dvec3(m(3), m(4), m(5)), touch.arms[side]);
        s += side == 0 ? -d : d;
    }
    return Vec3<Real>(s);
}

template <class Real>
void RigidRows<Real>::solve(std::span<Motion> motions) const {
    if (pairs_.empty()) {
        for (std::size_t b = 0; b < motions.size(); ++b) motions[b] = level_.inverse(bodies_[b]) * motions[b];
        return;
    }
    const auto size = static_cast<Eigen::Index>(6 * motions.size());
    Eigen::VectorXd right(size);
    for (std::size_t b = 0; b < motions.size(); ++b)
        right.segment<6>(static_cast<Eigen::Index>(6 * b)) = motions[b];
    const Eigen::VectorXd found = factors_.solve(right);
    for (std::size_t b = 0; b < motions.size(); ++b)
        motions[b] = found.segment<6>(static_cast<Eigen::Index>(6 * b));
}

template class RigidRows<float>;
template class RigidRows<double>;

}  // namespace gelatin::cpu
