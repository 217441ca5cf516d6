#include "cpu/implicit/island_solve.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "cpu/contact/tuning.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

constexpr std::size_t kChunk = 1024;  // of a sum

std::vector<Range> nodes_of(const Model& model, std::span<const std::uint32_t> bodies) {
    std::vector<Range> ranges;
    for (const std::uint32_t o : bodies) ranges.push_back(model.objects[o].nodes);
    return ranges;
}

template <class Real>
std::vector<std::uint32_t> free_ones(const RigidLevel<Real>& rigid, std::span<const std::uint32_t> bodies) {
    std::vector<std::uint32_t> some;
    std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(some),
                 [&](std::uint32_t o) { return rigid.is_free(o); });
    return some;
}

}  // namespace

template <class Real>
IslandSolve<Real>::IslandSolve(StepSystem<Real>& system, std::span<const std::uint32_t> bodies,
                               const Range& rows)
    : system_(system),
      bodies_(bodies.begin(), bodies.end()),
      nodes_(nodes_of(*system.model_, bodies)),
      rows_(std::span(system.rows).subspan(rows.first, rows.count)),
      tangents_(std::span(system.tangents_).subspan(rows.first, rows.count)),
      row_forces_(std::span(system.row_forces_).subspan(rows.first, rows.count)),
      slips_(std::span(system.slips_).subspan(rows.first, rows.count)),
      rigid_(system.rigid, free_ones(system.rigid, bodies), rows_) {
    for (const std::uint32_t o : bodies) places_.push_back(rigid_.place_of(o));
}

// force_of(row number): on the second side.
template <class Real>
template <class ForceOf>
void IslandSolve<Real>::find_row_forces(const ForceOf& force_of) {
    for_each_index(rows_.size(), [&](std::size_t r) { row_forces_[r] = force_of(r); });
}

// What they add to the forces on a node.
template <class Real>
Vec3<Real> IslandSolve<Real>::of_rows(std::uint32_t node) const {
    Vec3<Real> sum(0);
    for (std::uint32_t e = system_.row_starts_[node]; e < system_.row_starts_[node + 1]; ++e) {
        const std::uint32_t entry = system_.row_entries_[e];
        sum += system_.rows[entry / 4].weights[entry % 4] * system_.row_forces_[entry / 4];
    }
    return sum;
}

template <class Real>
void IslandSolve<Real>::find_slips() {
    for_each_index(rows_.size(),
                   [&](std::size_t r) { slips_[r] = relative<Real>(rows_[r], system_.displacements); });
}

template <class Real>
void IslandSolve<Real>::find_tangents() {
    for_each_index(rows_.size(), [&](std::size_t r) { tangents_[r] = tangent(rows_[r], slips_[r]); });
}

// In place of tangents, for a first step that closes gaps: from the gap at the start to the one expected.
template <class Real>
void IslandSolve<Real>::find_chords(std::span<const Vec3<Real>> expected) {
    for_each_index(rows_.size(), [&](std::size_t r) {
        const ContactRow<Real>& row = rows_[r];
        const Vec3<Real>& s = expected[r];
        RowTangent<Real> t;
        const Real there = row.gap_at(s);
        if (std::min(row.gap, there) < row.reach) {
            const Real from = std::min(row.gap, row.reach);
            const Real to =
                row.gap > Real(0) ? std::max(there, static_cast<Real>(tuning::kChordGap) * from) : there;
            const Real force = row.force_of(from);
            Real slope = row.stiffness;
            if (to < from * Real(0.999999)) {
                slope = (row.force_of(to) - force) / (from - to);
            } else if (from < row.reach) {
                slope = row.slope_of(from);
            }
            t.constant = (force + slope * (from - row.gap)) * row.normal;
            t.stiffness.add_outer(slope + row.damping, row.normal);
        }
        if (row.limit > Real(0)) {
            ContactRow<Real> friction = row;
            friction.reach = Real(0);
            friction.gap = Real(1);
            const RowTangent<Real> f = tangent(friction, s);
            t.constant += f.constant;
            t.stiffness.diagonal += f.stiffness.diagonal;
            t.stiffness.beside += f.stiffness.beside;
        }
        tangents_[r] = t;
    });
}

template <class Real>
void IslandSolve<Real>::set_limits() {
    for_each_index(rows_.size(),
                   [&](std::size_t r) { rows_[r].limit = rows_[r].friction * rows_[r].pressing(slips_[r]); });
}

template <class Real>
void IslandSolve<Real>::prepare_preconditioner(bool only_rows) {
    nodes_.for_each([&](std::uint32_t n) {
        const bool has_rows = system_.row_starts_[n] < system_.row_starts_[n + 1];
        if (system_.inertia[n] == Real(0) || (only_rows && !has_rows)) return;
        SymmetricMatrix<Real> block = system_.elastic.diagonal()[n];
        block.add_identity(system_.inertia[n]);
        for (std::uint32_t e = system_.row_starts_[n]; e < system_.row_starts_[n + 1]; ++e) {
            const std::uint32_t entry = system_.row_entries_[e];
            const Real weight = system_.rows[entry / 4].weights[entry % 4];
            const SymmetricMatrix<Real>& stiffness = system_.tangents_[entry / 4].stiffness;
            block.diagonal += weight * weight * stiffness.diagonal;
            block.beside += weight * weight * stiffness.beside;
        }
        system_.inverse_blocks_[n] = inverse_of(block);
    });
    rigid_.factorise(tangents_);
}

// use(node, displacement [m]) for all nodes; 0 for bodies that are not free.
template <class Real>
template <class Use>
void IslandSolve<Real>::for_displacements(std::span<const Motion> motions, const Use& use) const {
    nodes_.for_each_piece([&](const ObjectPieces::Piece& piece) {
        Vec3<Real> displacement(0), rotation(0);
        if (const std::uint32_t b = places_[piece.object]; b != kNoNode) {
            const Motion& m = motions[b];
            displacement = Vec3<Real>(m(0), m(1), m(2));
            rotation = Vec3<Real>(m(3), m(4), m(5));
        }
        for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n)
            use(n, displacement + glm::cross(rotation, system_.rigid.arm(n)));
    });
}

// z = M^-1 r: z_ by nodes' blocks, and the rigid level. update(n): of free nodes, what residual_ becomes.
// @param is_enough output: whether no body may lack more of its least energy than it should @return r . z
template <class Real>
template <class Update>
double IslandSolve<Real>::precondition(const Update& update, bool& is_enough) {
    struct Part {
        double lack = 0.0;  // r . z
        glm::dvec3 force{0.0}, moment{0.0};
    };
    std::vector<Part> parts(bodies_.size());
    nodes_.for_values(
        [&](const ObjectPieces::Piece& piece) {
            Part part;
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                if (system_.inertia[n] == Real(0)) continue;
                const Vec3<Real> r = update(n), z = system_.inverse_blocks_[n] * r;
                system_.residual_[n] = r;
                system_.z_[n] = z;
                part.lack += static_cast<double>(glm::dot(r, z));
                const glm::dvec3 force(r);
                part.force += force;
                part.moment += glm::cross(glm::dvec3(system_.rigid.arm(n)), force);
            }
            return part;
        },
        [&](const ObjectPieces::Piece& piece, const Part& more) {
            Part& sum = parts[piece.object];
            sum.lack += more.lack;
            sum.force += more.force;
            sum.moment += more.moment;
        });
    std::vector<Motion> forces(rigid_.count());
    for (std::size_t k = 0; k < parts.size(); ++k)
        if (places_[k] != kNoNode) forces[places_[k]] = motion(parts[k].force, parts[k].moment);
    rigid_z_ = forces;
    rigid_.solve(rigid_z_);
    is_enough = true;
    double sum = 0.0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        double lack = parts[k].lack;
        if (places_[k] != kNoNode) lack += forces[places_[k]].dot(rigid_z_[places_[k]]);
        is_enough = is_enough && lack <= system_.enough[bodies_[k]];
        sum += lack;
    }
    return sum;
}

// product_ = A p, rows among it. @return p . A p
template <class Real>
double IslandSolve<Real>::multiply_direction() {
    ++counts_.products;
    const std::vector<Vec4<Real>>& p = system_.elastic.displacements;
    find_row_forces([&](std::size_t r) { return tangents_[r].stiffness * relative<Real>(rows_[r], p); });
    for (const std::uint32_t o : bodies_) system_.elastic.begin_product(system_.model_->objects[o]);
    double curvature = 0.0;
    nodes_.for_values(
        [&](const ObjectPieces::Piece& piece) {
            system_.elastic.multiply(piece.range, system_.product_);
            double sum = 0.0;
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                if (system_.inertia[n] == Real(0)) continue;
                const Vec3<Real> d(p[n]), all = system_.product_[n] + system_.inertia[n] * d + of_rows(n);
                system_.product_[n] = all;
                sum += static_cast<double>(glm::dot(d, all));
            }
            return sum;
        },
        [&](const ObjectPieces::Piece&, double sum) { curvature += sum; });
    return curvature;
}

// From no step, with the linear residual in residual_. A step makes one iteration at least: what elements
// exert counts, however short it is.
// @param forcing part of what is lacking at first that may be left @return iterations
template <class Real>
int IslandSolve<Real>::conjugate_gradients(int count, double forcing) {
    bool is_enough = false;
    double rz = precondition([&](std::uint32_t n) { return system_.residual_[n]; }, is_enough);
    const double enough_of_all = forcing * rz;
    std::vector<Vec4<Real>>& p = system_.elastic.displacements;
    nodes_.for_each([&](std::uint32_t n) {  // held ones, too
        p[n] = Vec4<Real>(0);
        system_.step_[n] = Vec3<Real>(0);
    });
    Real b = 0;
    int k = 0;
    while (k < count && ((!is_enough && rz > enough_of_all) || (counts_.iterations == 0 && rz > 0.0))) {
        for_displacements(rigid_z_, [&](std::size_t n, const Vec3<Real>& rigid_part) {
            if (system_.inertia[n] > Real(0))
                p[n] = Vec4<Real>(system_.z_[n] + rigid_part + b * Vec3<Real>(p[n]), 0);
        });
        ++counts_.iterations;
        const double curvature = multiply_direction();
        if (!(curvature > 0.0)) return k;
        ++k;
        const auto a = static_cast<Real>(rz / curvature);
        const double next = precondition(
            [&](std::uint32_t n) {
                system_.step_[n] += a * Vec3<Real>(p[n]);
                return system_.residual_[n] - a * system_.product_[n];
            },
            is_enough);
        b = static_cast<Real>(next / rz);
        rz = next;
    }
    return k;
}

// How far along a direction the objective falls, by at most all of it. @param changes of s @param base what
// pulls along it without rows, and by how much less it does so at its end
template <class Real>
double IslandSolve<Real>::line_search(std::span<const Vec3<Real>> changes, double base, double curvature) {
    std::vector<double> sums((rows_.size() + kChunk - 1) / kChunk);
    const auto fall = [&](double t) {  // minus the slope
        for_each_index(0, sums.size(), 1, [&](std::size_t c) {
            double sum = 0.0;
            for (std::size_t r = c * kChunk; r < std::min(rows_.size(), (c + 1) * kChunk); ++r) {
                const Vec3<Real> force = rows_[r].force(slips_[r] + static_cast<Real>(t) * changes[r]);
                sum += static_cast<double>(glm::dot(changes[r], force));
            }
            sums[c] = sum;
        });
        return std::accumulate(sums.begin(), sums.end(), base - t * curvature);
    };
    const double first = fall(0.0);
    if (!(first > 0.0)) return 0.0;
    if (fall(1.0) >= -tuning::kTurned * first) return 1.0;
    ++counts_.line_searches;
    double low = 0.0, high = 1.0;
    for (int k = 0; k < tuning::kMostRounds; ++k) {
        const double middle = 0.5 * (low + high);
        (fall(middle) > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// Whether what is left of all forces on each body is no more than a part of what presses it.
template <class Real>
bool IslandSolve<Real>::is_balanced(double tolerance, std::span<const Motion> forces) const {
    std::vector<double> pressing(rigid_.count(), 0.0);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const auto force = static_cast<double>(rows_[r].pressing(slips_[r]));
        for (const std::uint32_t b : rigid_.bodies_of(r))
            if (b != kNoNode) pressing[b] += force;
    }
    const double gravity = glm::length(glm::dvec3(system_.model_->gravity));
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const std::uint32_t b = places_[k];
        if (b == kNoNode || !(pressing[b] > 0.0)) continue;
        const double weight = gravity * system_.model_->objects[bodies_[k]].mass;
        const double scale =
            weight > 0.0 ? std::min(pressing[b], 2.0 * weight) + 0.05 * pressing[b] : pressing[b];
        if (forces[b].template head<3>().norm() > tolerance * scale) return false;
    }
    return true;
}

// W^T of what elements and inertia lack.
template <class Real>
std::vector<Motion> IslandSolve<Real>::gather_base() const {
    std::vector<Motion> sums(rigid_.count(), Motion::Zero());
    nodes_.for_values(
        [&](const ObjectPieces::Piece& piece) -> Motion {
            glm::dvec3 force(0.0), moment(0.0);
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                const glm::dvec3 r(system_.base_[n]);
                force += r;
                moment += glm::cross(glm::dvec3(system_.rigid.arm(n)), r);
            }
            return motion(force, moment);
        },
        [&](const ObjectPieces::Piece& piece, const Motion& part) {
            if (places_[piece.object] != kNoNode) sums[places_[piece.object]] += part;
        });
    return sums;
}

// Newton's method on rigid motions alone, in which only their forces and rows count. The limits of
// friction stay as they are until bodies are nearly in balance (Tresca's friction), since what presses before
// that has little to do with what will.
template <class Real>
void IslandSolve<Real>::rigid_newton() {
    if (rigid_.count() == 0) return;
    std::vector<Motion> base = gather_base(), moved(rigid_.count(), Motion::Zero());
    std::vector<Vec3<Real>> changes(rows_.size());
    const auto forces = [&] {
        find_row_forces([&](std::size_t r) { return rows_[r].force(slips_[r]); });
        std::vector<Motion> sums = base;
        rigid_.add_rows(row_forces_, sums);
        return sums;
    };
    for (int k = 0; k < tuning::kMostRounds; ++k) {
        std::vector<Motion> step = forces();
        if (is_balanced(tuning::kNearBalance, step)) {
            set_limits();
            step = forces();
            if (k > 0 && is_balanced(tuning::kBalance, step)) break;
        }
        ++counts_.rigid_rounds;
        find_tangents();
        rigid_.factorise(tangents_);
        rigid_.solve(step);
        for_each_index(rows_.size(), [&](std::size_t r) { changes[r] = rigid_.relative(r, step); });
        const std::vector<Motion> resistance = rigid_.resistance(step);
        double pull = 0.0, curvature = 0.0;
        for (std::size_t b = 0; b < step.size(); ++b) {
            pull += step[b].dot(base[b]);
            curvature += step[b].dot(resistance[b]);
        }
        const double part = line_search(changes, pull, curvature);
        for (std::size_t b = 0; b < step.size(); ++b) {
            moved[b] += part * step[b];
            base[b] -= part * resistance[b];
        }
        for_each_index(rows_.size(),
                       [&](std::size_t r) { slips_[r] += static_cast<Real>(part) * changes[r]; });
    }
    for_displacements(moved, [&](std::size_t n, const Vec3<Real>& d) { system_.displacements[n] += d; });
}

// A Newton step on all nodes, from the tangents that are set. @param is_first of this system
// @return whether there was any to make
template <class Real>
bool IslandSolve<Real>::newton_step(int most_iterations, double forcing, bool is_first) {
    prepare_preconditioner(!is_first);
    find_row_forces([&](std::size_t r) { return tangents_[r].force(slips_[r]); });
    nodes_.for_each([&](std::uint32_t n) {
        system_.residual_[n] = system_.inertia[n] > Real(0) ? system_.base_[n] + of_rows(n) : Vec3<Real>(0);
    });
    if (conjugate_gradients(most_iterations, forcing) == 0) return false;
    // A times the step, without rows: what the residual lost, less what rows did.
    std::vector<Vec3<Real>> changes(rows_.size());
    find_row_forces([&](std::size_t r) {
        changes[r] = relative<Real>(rows_[r], system_.step_);
        return tangents_[r].force(slips_[r]) - tangents_[r].stiffness * changes[r];
    });
    glm::dvec2 sum(0.0);
    nodes_.for_values(
        [&](const ObjectPieces::Piece& piece) {
            glm::dvec2 of_piece(0.0);
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                if (system_.inertia[n] == Real(0)) continue;
                const Vec3<Real> step = system_.step_[n],
                                 resists = system_.base_[n] + of_rows(n) - system_.residual_[n];
                system_.product_[n] = resists;
                of_piece += glm::dvec2(glm::dot(step, system_.base_[n]), glm::dot(step, resists));
            }
            return of_piece;
        },
        [&](const ObjectPieces::Piece&, const glm::dvec2& more) { sum += more; });
    const auto part = static_cast<Real>(rows_.empty() ? 1.0 : line_search(changes, sum.x, sum.y));
    nodes_.for_each([&](std::uint32_t n) {
        if (system_.inertia[n] == Real(0)) return;
        system_.displacements[n] += part * system_.step_[n];
        system_.base_[n] -= part * system_.product_[n];
    });
    find_slips();
    return true;
}

// With the product of the displacements begun.
template <class Real>
void IslandSolve<Real>::find_base_residual() {
    ++counts_.products;
    nodes_.for_each_piece([&](const ObjectPieces::Piece& piece) {
        system_.elastic.multiply(piece.range, system_.product_);
        for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
            const Real inertia = system_.inertia[n];
            system_.base_[n] =
                inertia > Real(0)
                    ? system_.loads[n] - (system_.product_[n] + inertia * system_.displacements[n])
                    : Vec3<Real>(0);
        }
    });
}

template <class Real>
SolveCounts IslandSolve<Real>::run() {
    find_slips();
    const std::vector<Vec3<Real>> expected(slips_.begin(), slips_.end());
    if (!rows_.empty()) {  // elements hardly resist rigid motions
        nodes_.for_each([&](std::uint32_t n) {
            system_.base_[n] = system_.loads[n] - system_.inertia[n] * system_.displacements[n];
        });
        rigid_newton();
    }
    nodes_.for_each(
        [&](std::uint32_t n) { system_.elastic.displacements[n] = Vec4<Real>(system_.displacements[n], 0); });
    for (const std::uint32_t o : bodies_) system_.elastic.begin_product(system_.model_->objects[o]);
    find_base_residual();
    find_chords(expected);
    if (rows_.empty()) {
        newton_step(2 * system_.iterations, 0.0, true);
    } else {
        for (int k = 0;
             k < tuning::kMostLinearisations && newton_step(system_.iterations, tuning::kForcing, k == 0);
             ++k)
            find_tangents();
    }
    rigid_newton();
    return counts_;
}

template class IslandSolve<float>;
template class IslandSolve<double>;

}  // namespace gelatin::cpu
