#include "cpu/implicit/rigid_level.h"

#include <Eigen/LU>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <unordered_map>
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

glm::dmat3 rotation_about(const glm::dvec3& w) {
    const double angle = glm::length(w);
    return angle > 0.0 ? glm::mat3_cast(glm::angleAxis(angle, w / angle)) : glm::dmat3(1.0);
}

}  // namespace

template <class Real>
RigidLevel<Real>::RigidLevel(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      numbers_(model_->objects.size(), kNoNode),
      body_of_(model_->node_count(), kNoNode),
      pieces_(node_ranges(*model_)),
      arms_(model_->node_count()) {}

template <class Real>
void RigidLevel<Real>::begin(std::span<const Vec4<Real>> positions, std::span<const Real> inertia) {
    bodies_.clear();
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        const Range& nodes = model_->objects[o].nodes;
        const auto first = inertia.begin() + nodes.first;
        const bool is_free = std::all_of(first, first + nodes.count, [](Real i) { return i > Real(0); });
        numbers_[o] = is_free ? static_cast<std::uint32_t>(bodies_.size()) : kNoNode;
        if (is_free) bodies_.push_back({o});
    }
    for_each_index(0, model_->body_count(), 1, [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        std::fill_n(body_of_.begin() + nodes.first, nodes.count, numbers_[o]);
        if (numbers_[o] == kNoNode) return;
        Body& body = bodies_[numbers_[o]];
        const glm::dvec3 origin(positions[nodes.first]);
        RigidSums sums;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sums.add(glm::dvec3(positions[n]) - origin, static_cast<double>(inertia[n]), glm::dvec3(0.0));
        const glm::dvec3 middle = sums.arm / sums.stiffness;
        body.center = origin + middle;
        body.weight = sums.stiffness / model_->objects[o].mass;
        sums.square.add_outer(-sums.stiffness, middle);
        sums.arm = glm::dvec3(0.0);
        body.matrix = inertia_matrix(sums);
        body.inverse = body.matrix.inverse();
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            arms_[n] = Vec3<Real>(glm::dvec3(positions[n]) - body.center);
    });
}

template <class Real>
Motion RigidLevel<Real>::velocity(std::size_t object, std::span<const Vec4<Real>> velocities) const {
    const Range& nodes = model_->objects[object].nodes;
    glm::dvec3 momentum(0.0), angular(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 p = static_cast<double>(model_->masses[n]) * glm::dvec3(velocities[n]);
        momentum += p;
        angular += glm::cross(glm::dvec3(arms_[n]), p);
    }
    const Body& body = bodies_[numbers_[object]];
    return body.weight * (body.inverse * motion(momentum, angular));
}

template <class Real>
void RigidLevel<Real>::set_rows(std::span<const ContactRow<Real>> rows) {
    touches_.resize(rows.size());
    for_each_index(rows.size(), [&](std::size_t r) {
        const ContactRow<Real>& row = rows[r];
        Touch touch;
        for (std::size_t side = 0; side < 2; ++side) {
            const std::uint32_t object = side == 0 ? row.object : row.other;
            if (object == kNoNode || numbers_[object] == kNoNode) continue;
            touch.bodies[side] = numbers_[object];
            for (std::uint32_t k = 0; k < row.count; ++k)
                if ((side == 0) == (row.weights[k] < Real(0)))
                    touch.arms[side] +=
                        std::abs(static_cast<double>(row.weights[k])) * glm::dvec3(arms_[row.nodes[k]]);
        }
        touches_[r] = touch;
    });
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
    pairs_.clear();
    pair_of_row_.resize(rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const auto& [first, second] = touches_[r].bodies;
        const std::uint64_t key = std::uint64_t(first) << 32 | second;
        const auto [at, is_new] = numbers.try_emplace(key, static_cast<std::uint32_t>(pairs_.size()));
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

// Blocks of 6 x 6, those of a column in the order of their rows, the one on the diagonal first.
template <class Real>
void RigidLevel<Real>::find_pattern() {
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
void RigidLevel<Real>::factorise(std::span<const RowTangent<Real>> tangents) {
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
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) add(bodies_[b].matrix, b, 0);
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
std::vector<Motion> RigidLevel<Real>::gather(std::span<const Vec3<Real>> residual) const {
    std::vector<Motion> by_object(model_->objects.size(), Motion::Zero());
    pieces_.gather(
        std::span<Motion>(by_object),
        [&](const ObjectPieces::Piece& piece) -> Motion {
            if (numbers_[piece.object] == kNoNode) return Motion::Zero();
            glm::dvec3 force(0.0), moment(0.0);
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                force += glm::dvec3(residual[n]);
                moment += glm::dvec3(glm::cross(arms_[n], residual[n]));
            }
            return motion(force, moment);
        },
        [](Motion& sum, const Motion& more) { sum += more; });
    std::vector<Motion> by_body;
    for (const Body& body : bodies_) by_body.push_back(by_object[body.object]);
    return by_body;
}

template <class Real>
void RigidLevel<Real>::add_rows(std::span<const Vec3<Real>> forces, std::span<Motion> sums) const {
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
std::vector<Motion> RigidLevel<Real>::resistance(std::span<const Motion> motions) const {
    std::vector<Motion> forces(motions.size());
    for (std::size_t b = 0; b < motions.size(); ++b) forces[b] = bodies_[b].matrix * motions[b];
    return forces;
}

template <class Real>
Vec3<Real> RigidLevel<Real>::relative(std::size_t row, std::span<const Motion> motions) const {
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
void RigidLevel<Real>::solve(std::span<Motion> motions) const {
    if (pairs_.empty()) {
        for (std::size_t b = 0; b < motions.size(); ++b) motions[b] = bodies_[b].inverse * motions[b];
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

template <class Real>
Motion RigidLevel<Real>::rigid_part(const Body& body, std::span<const Vec4<Real>> positions,
                                    std::span<const Real> inertia,
                                    std::span<const Vec3<Real>> displacements) const {
    const Range& nodes = model_->objects[body.object].nodes;
    glm::dvec3 sum(0.0), moment(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 d = static_cast<double>(inertia[n]) * glm::dvec3(displacements[n]);
        sum += d;
        moment += glm::cross(glm::dvec3(positions[n]) - body.center, d);
    }
    return body.inverse * motion(sum, moment);
}

template <class Real>
void RigidLevel<Real>::follow_rotation(std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                                       std::span<Vec3<Real>> displacements,
                                       std::span<Vec3<Real>> forces) const {
    for_each_index(0, bodies_.size(), 1, [&](std::size_t b) {
        const Body& body = bodies_[b];
        const Motion rigid = rigid_part(body, positions, inertia, displacements);
        const glm::dvec3 w(rigid(3), rigid(4), rigid(5));
        const Range& nodes = model_->objects[body.object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 r = glm::dvec3(positions[n]) - body.center;
            displacements[n] -= Vec3<Real>(0.5 * glm::cross(w, glm::cross(w, r)));
            forces[n] += glm::cross(Vec3<Real>(w), forces[n]);
        }
    });
}

template <class Real>
void RigidLevel<Real>::rotate(std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                              std::span<Vec3<Real>> displacements) const {
    for_each_index(0, bodies_.size(), 1, [&](std::size_t b) {
        const Body& body = bodies_[b];
        const Motion rigid = rigid_part(body, positions, inertia, displacements);
        const glm::dvec3 s(rigid(0), rigid(1), rigid(2)), w(rigid(3), rigid(4), rigid(5));
        const glm::dmat3 rotation = rotation_about(w);
        const Range& nodes = model_->objects[body.object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 r = glm::dvec3(positions[n]) - body.center;
            const glm::dvec3 rest = glm::dvec3(displacements[n]) - s - glm::cross(w, r);
            displacements[n] = Vec3<Real>(s + rotation * (r + rest) - r);
        }
    });
}

template class RigidLevel<float>;
template class RigidLevel<double>;

}  // namespace gelatin::cpu
