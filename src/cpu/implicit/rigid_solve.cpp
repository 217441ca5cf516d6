#include "cpu/implicit/rigid_solve.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "cpu/contact/tuning.h"
#include "cpu/implicit/rigid_bodies.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// m [r], where [r] v = r x v.
glm::dmat3 times_cross(const glm::dmat3& m, const glm::dvec3& r) {
    return {m[1] * r.z - m[2] * r.y, m[2] * r.x - m[0] * r.z, m[0] * r.y - m[1] * r.x};
}

// [r] m
glm::dmat3 cross_times(const glm::dvec3& r, const glm::dmat3& m) {
    return {glm::cross(r, m[0]), glm::cross(r, m[1]), glm::cross(r, m[2])};
}

// The same of glm and of Eigen, which both have columns one after the other.
Eigen::Map<const Eigen::Matrix3d> eigen(const glm::dmat3& m) {
    return Eigen::Map<const Eigen::Matrix3d>(&m[0][0]);
}

// Of a symmetric matrix.
glm::dmat3 positive_part(const glm::dmat3& m) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(eigen(m));
    glm::dmat3 part(0.0);
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 a(solved.eigenvectors()(0, k), solved.eigenvectors()(1, k),
                           solved.eigenvectors()(2, k));
        part += std::max(solved.eigenvalues()(k), 0.0) * glm::outerProduct(a, a);
    }
    return part;
}

double dot(std::span<const Motion> a, std::span<const Motion> b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
    return sum;
}

}  // namespace

template <class Real>
RigidSolve<Real>::RigidSolve(const Model& model, const RigidLevel<Real>& level,
                             std::vector<std::uint32_t> bodies, const IslandRows<Real>& rows,
                             std::span<const RowPair> pairs)
    : model_(model),
      level_(level),
      rows_(rows),
      bodies_(std::move(bodies)),
      arms_(rows.count()),
      pair_of_row_(rows.count()),
      coupling_starts_(bodies_.size() + 1) {
    for (const std::uint32_t o : bodies_) are_rigid_.push_back(model.objects[o].is_rigid ? 1 : 0);
    turning_.resize(bodies_.size(), glm::dmat3(0.0));
    for (const RowPair& pair : pairs) {
        for (std::uint32_t r = pair.rows.first; r < pair.rows.end(); ++r)
            pair_of_row_[r] = static_cast<std::uint32_t>(pairs_.size());
        pairs_.push_back({.bodies = {kNoNode, kNoNode}, .rows = pair.rows});
        if (pair.object != pair.other) pairs_.back().bodies = {place_of(pair.object), place_of(pair.other)};
        for (const std::uint32_t b : pairs_.back().bodies)
            if (b != kNoNode) ++coupling_starts_[b + 1];
    }
    std::partial_sum(coupling_starts_.begin(), coupling_starts_.end(), coupling_starts_.begin());
    couplings_.resize(coupling_starts_.back());
    std::vector<std::uint32_t> next(coupling_starts_.begin(), coupling_starts_.end() - 1);
    for (std::uint32_t p = 0; p < pairs_.size(); ++p)
        for (std::uint32_t side = 0; side < 2; ++side)
            if (const std::uint32_t b = pairs_[p].bodies[side]; b != kNoNode)
                couplings_[next[b]++] = {p, side};
    for_each_index(rows.count(), [&](std::size_t r) {
        const ContactRow<Real>& row = rows.rows[r];
        arms_[r] = {glm::dvec3(0.0), glm::dvec3(0.0)};
        for (std::uint32_t k = 0; k < row.count; ++k) {
            const std::uint32_t n = row.nodes[k];
            const std::size_t side = level_.number_at(n) == level_.number(row.other) ? 1 : 0;
            if (pairs_[pair_of_row_[r]].bodies[side] != kNoNode)
                arms_[r][side] += (side == 0 ? -1.0 : 1.0) * static_cast<double>(row.weights[k]) *
                                  glm::dvec3(level_.arm(n));
        }
    });
    straight_arms_ = arms_;
}

// To where motions have brought rigid bodies.
template <class Real>
void RigidSolve<Real>::rotate(std::span<const Motion> motions) {
    if (std::find(are_rigid_.begin(), are_rigid_.end(), 1) == are_rigid_.end()) return;
    std::vector<glm::dmat3> rotations;
    for (const Motion& m : motions) rotations.push_back(rotation_about(rotation(m)));
    for_each_index(rows_.count(), [&](std::size_t r) {
        glm::dvec3 turned(0.0);
        for (std::size_t side = 0; side < 2; ++side) {
            const std::uint32_t b = pairs_[pair_of_row_[r]].bodies[side];
            if (b == kNoNode || are_rigid_[b] == 0) continue;
            const glm::dvec3& arm = straight_arms_[r][side];
            arms_[r][side] = rotations[b] * arm;
            const glm::dvec3 more = arms_[r][side] - arm - glm::cross(rotation(motions[b]), arm);
            turned += side == 0 ? -more : more;
        }
        ContactRow<Real>& row = rows_.rows[r];
        const Vec3<Real> change = Vec3<Real>(turned) - row.turned;
        rows_.slips[r] += row.is_tie() ? row.held_part(change) : change;
        row.turned = Vec3<Real>(turned);
    });
}

// By the forces of rows.
template <class Real>
void RigidSolve<Real>::find_turning() {
    for_each_index(0, count(), 8, [&](std::size_t b) {
        if (are_rigid_[b] == 0) return;
        glm::dmat3 sum(0.0);
        for (std::uint32_t c = coupling_starts_[b]; c < coupling_starts_[b + 1]; ++c) {
            const auto& [p, side] = couplings_[c];
            for (std::uint32_t r = pairs_[p].rows.first; r < pairs_[p].rows.end(); ++r) {
                const glm::dvec3 f = (side == 0 ? -1.0 : 1.0) * glm::dvec3(rows_.forces[r]),
                                 &arm = arms_[r][side];
                const glm::dmat3 outer = 0.5 * glm::outerProduct(f, arm);
                sum += glm::dmat3(glm::dot(f, arm)) - outer - glm::transpose(outer);
            }
        }
        turning_[b] = positive_part(sum);
    });
}

template <class Real>
std::uint32_t RigidSolve<Real>::place_of(std::uint32_t object) const {
    const auto at = std::lower_bound(bodies_.begin(), bodies_.end(), object);
    return at != bodies_.end() && *at == object ? static_cast<std::uint32_t>(at - bodies_.begin()) : kNoNode;
}

template <class Real>
void RigidSolve<Real>::find_matrix(std::span<const RowTangent<Real>> tangents) {
    for_each_index(0, pairs_.size(), 1, [&](std::size_t p) {
        Pair& pair = pairs_[p];
        pair = {.bodies = pair.bodies, .rows = pair.rows};
        if (pair.bodies[0] == kNoNode && pair.bodies[1] == kNoNode) return;
        for (std::uint32_t r = pair.rows.first; r < pair.rows.end(); ++r) {
            const SymmetricMatrix<Real>& h = tangents[r].stiffness;
            if (!(h.diagonal.x + h.diagonal.y + h.diagonal.z > Real(0))) continue;
            const glm::dmat3 stiffness = full({glm::dvec3(h.diagonal), glm::dvec3(h.beside)});
            const double whole = rows_.rows[r].is_couple ? 0.0 : 1.0;
            pair.stiffness += whole * stiffness;
            for (std::size_t side = 0; side < 2; ++side) {
                const glm::dmat3 by_rotation = times_cross(-stiffness, arms_[r][side]);
                pair.by_rotation[side] += whole * by_rotation;
                pair.moments[side] += cross_times(arms_[r][side], by_rotation);
                if (side == 1) pair.across += cross_times(arms_[r][0], by_rotation);
            }
        }
    });
    diagonal_.resize(count());
    inverses_.resize(count());
    for_each_index(0, count(), 8, [&](std::size_t b) {
        MotionMatrix& own = diagonal_[b] = level_.matrix(bodies_[b]);
        own.bottomRightCorner<3, 3>() += eigen(turning_[b]);
        for (std::uint32_t c = coupling_starts_[b]; c < coupling_starts_[b + 1]; ++c) {
            const auto& [p, side] = couplings_[c];
            const Pair& pair = pairs_[p];
            own.topLeftCorner<3, 3>() += eigen(pair.stiffness);
            own.topRightCorner<3, 3>() += eigen(pair.by_rotation[side]);
            own.bottomLeftCorner<3, 3>() += eigen(pair.by_rotation[side]).transpose();
            own.bottomRightCorner<3, 3>() += eigen(pair.moments[side]);
        }
        inverses_[b] = coupling_starts_[b] == coupling_starts_[b + 1] ? level_.inverse(bodies_[b])
                                                                      : own.inverse().eval();
    });
}

template <class Real>
std::vector<Motion> RigidSolve<Real>::multiply(std::span<const Motion> motions) const {
    std::vector<Motion> forces(motions.size());
    for_each_index(0, motions.size(), 128, [&](std::size_t b) {
        glm::dvec3 force(0.0), moment(0.0);
        for (std::uint32_t c = coupling_starts_[b]; c < coupling_starts_[b + 1]; ++c) {
            const auto& [p, side] = couplings_[c];
            const Pair& pair = pairs_[p];
            const std::uint32_t other = pair.bodies[1 - side];
            if (other == kNoNode) continue;
            const glm::dvec3 s = translation(motions[other]), w = rotation(motions[other]);
            force -= pair.stiffness * s + pair.by_rotation[1 - side] * w;
            moment -= s * pair.by_rotation[side] + (side == 0 ? pair.across * w : w * pair.across);
        }
        forces[b] = diagonal_[b] * motions[b] + motion(force, moment);
    });
    return forces;
}

template <class Real>
std::uint32_t RigidSolve<Real>::solve(std::span<Motion> motions, double left) const {
    std::vector<Motion> residual(motions.begin(), motions.end()), z(count());
    const auto find_z = [&] {
        for (std::size_t b = 0; b < count(); ++b) z[b] = precondition(b, residual[b]);
        return dot(residual, z);
    };
    double rz = find_z();
    std::vector<Motion> p = z;
    std::fill(motions.begin(), motions.end(), Motion::Zero());
    const double enough = left * rz;
    std::uint32_t k = 0;
    while (rz > enough && k < tuning::kMostRigidIterations) {
        const std::vector<Motion> product = multiply(p);
        const double curvature = dot(p, product);
        if (!(curvature > 0.0)) break;
        ++k;
        const double a = rz / curvature;
        for (std::size_t b = 0; b < count(); ++b) {
            motions[b] += a * p[b];
            residual[b] -= a * product[b];
        }
        const double next = find_z();
        for (std::size_t b = 0; b < count(); ++b) p[b] = z[b] + next / rz * p[b];
        rz = next;
    }
    return k;
}

template <class Real>
void RigidSolve<Real>::add_rows(std::span<Motion> sums) const {
    std::vector<std::array<Motion, 2>> by_pair(pairs_.size());
    for_each_index(0, pairs_.size(), 1, [&](std::size_t p) {
        glm::dvec3 force(0.0), moments[2] = {glm::dvec3(0.0), glm::dvec3(0.0)};
        for (std::uint32_t r = pairs_[p].rows.first; r < pairs_[p].rows.end(); ++r) {
            const glm::dvec3 f(rows_.forces[r]);
            if (!rows_.rows[r].is_couple) force += f;
            for (std::size_t side = 0; side < 2; ++side) moments[side] += glm::cross(arms_[r][side], f);
        }
        by_pair[p] = {-motion(force, moments[0]), motion(force, moments[1])};
    });
    for (std::size_t p = 0; p < pairs_.size(); ++p)
        for (std::size_t side = 0; side < 2; ++side)
            if (pairs_[p].bodies[side] != kNoNode) sums[pairs_[p].bodies[side]] += by_pair[p][side];
}

template <class Real>
Vec3<Real> RigidSolve<Real>::relative(std::size_t row, const std::array<glm::dvec3, 2>& arms,
                                      std::span<const Motion> motions) const {
    const std::array<std::uint32_t, 2>& bodies = pairs_[pair_of_row_[row]].bodies;
    glm::dvec3 s(0.0);
    for (std::size_t side = 0; side < 2; ++side) {
        if (bodies[side] == kNoNode) continue;
        const Motion& m = motions[bodies[side]];
        glm::dvec3 d = glm::cross(rotation(m), arms[side]);
        if (!rows_.rows[row].is_couple) d += translation(m);
        s += side == 0 ? -d : d;
    }
    const ContactRow<Real>& of = rows_.rows[row];
    return Vec3<Real>(of.is_tie() ? of.held_part(s) : s);
}

// Whether what is left of all forces on each body is no more than a part of what presses it.
template <class Real>
bool RigidSolve<Real>::is_balanced(double tolerance, std::span<const Motion> forces) const {
    std::vector<double> pressing(count(), 0.0);
    for (const Pair& pair : pairs_) {
        double sum = 0.0;
        for (std::uint32_t r = pair.rows.first; r < pair.rows.end(); ++r)
            sum += rows_.rows[r].is_tie() ? glm::length(glm::dvec3(rows_.forces[r]))
                                          : static_cast<double>(rows_.rows[r].pressing(rows_.slips[r]));
        for (const std::uint32_t b : pair.bodies)
            if (b != kNoNode) pressing[b] += sum;
    }
    const double gravity = glm::length(glm::dvec3(model_.gravity));
    for (std::size_t b = 0; b < count(); ++b) {
        if (!(pressing[b] > 0.0)) continue;
        const double weight = gravity * model_.objects[bodies_[b]].mass;
        const double scale =
            weight > 0.0 ? std::min(pressing[b], 2.0 * weight) + 0.05 * pressing[b] : pressing[b];
        if (forces[b].template head<3>().norm() > tolerance * scale) return false;
        if (are_rigid_[b] == 0) continue;
        const MotionMatrix& inertia = level_.matrix(bodies_[b]);
        const double radius = std::sqrt(inertia.diagonal().template tail<3>().sum() / (2.0 * inertia(0, 0)));
        if (forces[b].template tail<3>().norm() > tolerance * scale * radius) return false;
    }
    return true;
}

// The limits of friction stay as they are until bodies are nearly in balance (Tresca's friction), since what
// presses before that has little to do with what will.
template <class Real>
std::vector<Motion> RigidSolve<Real>::run(std::vector<Motion> base, std::span<const Motion> begun) {
    std::vector<Motion> motions(count(), Motion::Zero()), all(begun.begin(), begun.end());
    rotate(all);
    std::vector<Vec3<Real>> changes(rows_.count());
    const auto forces = [&] {
        rows_.find_forces();
        std::vector<Motion> sums = base;
        add_rows(sums);
        return sums;
    };
    for (std::uint32_t round = 0; round < tuning::kMostRounds; ++round) {
        std::vector<Motion> step = forces();
        if (is_balanced(tuning::kNearly, step)) {
            rows_.set_limits();
            step = forces();
            if (round > 0 && is_balanced(tuning::kHardly, step)) break;
        }
        rows_.find_tangents();
        find_turning();
        find_matrix(rows_.tangents);
        solve(step, tuning::kRigidForcing);
        for_each_index(rows_.count(), [&](std::size_t r) { changes[r] = relative(r, step); });
        std::vector<Motion> resistance(count());
        double turning = 0.0;
        for (std::size_t b = 0; b < count(); ++b) {
            resistance[b] = level_.matrix(bodies_[b]) * step[b];
            turning += glm::dot(rotation(step[b]), turning_[b] * rotation(step[b]));
        }
        const double part = rows_.line_search(changes, dot(step, base), dot(step, resistance) + turning);
        for (std::size_t b = 0; b < count(); ++b) {
            motions[b] += part * step[b];
            all[b] += part * step[b];
            base[b] -= part * resistance[b];
        }
        for_each_index(rows_.count(), [&](std::size_t r) {
            rows_.slips[r] += static_cast<Real>(part) * relative(r, straight_arms_[r], step);
        });
        rotate(all);
    }
    return motions;
}

template class RigidSolve<float>;
template class RigidSolve<double>;

}  // namespace gelatin::cpu
