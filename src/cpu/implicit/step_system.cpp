#include "cpu/implicit/step_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "cpu/contact/tuning.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

constexpr std::size_t kChunk = 1024;  // of a sum

}  // namespace

template <class Real>
StepSystem<Real>::StepSystem(std::shared_ptr<const Model> model)
    : elastic(model),
      rigid(model),
      inertia(model->node_count()),
      loads(model->node_count()),
      displacements(model->node_count()),
      enough(model->objects.size(), 0.0),
      model_(std::move(model)),
      pieces_(node_ranges(*model_)),
      row_starts_(model_->node_count() + 1),
      inverse_blocks_(model_->node_count()) {
    for (Field* field : {&base_, &residual_, &step_, &product_, &z_}) field->resize(model_->node_count());
    leave_out(std::vector<std::uint8_t>(model_->body_count()));
}

template <class Real>
void StepSystem<Real>::leave_out(std::span<const std::uint8_t> asleep) {
    elastic.leave_out(asleep);
    std::vector<std::uint8_t> left_out(model_->objects.size(), 1);  // colliders, too
    std::copy(asleep.begin(), asleep.end(), left_out.begin());
    awake_ = pieces_.without(left_out);
    for (Field* field : {&base_, &residual_, &step_, &product_, &z_})
        std::fill(field->begin(), field->end(), Vec3<Real>(0));
    std::fill(elastic.displacements.begin(), elastic.displacements.end(), Vec4<Real>(0));
}

template <class Real>
void StepSystem<Real>::index_rows() {
    std::fill(row_starts_.begin(), row_starts_.end(), 0u);
    for (const ContactRow<Real>& row : rows)
        for (std::uint32_t k = 0; k < row.count; ++k) ++row_starts_[row.nodes[k] + 1];
    for (std::size_t n = 1; n < row_starts_.size(); ++n) row_starts_[n] += row_starts_[n - 1];
    row_entries_.resize(row_starts_.back());
    std::vector<std::uint32_t> next(row_starts_.begin(), row_starts_.end() - 1);
    for (std::uint32_t r = 0; r < rows.size(); ++r)
        for (std::uint32_t k = 0; k < rows[r].count; ++k) row_entries_[next[rows[r].nodes[k]]++] = 4 * r + k;
    tangents_.resize(rows.size());
    for (auto* values : {&row_forces_, &slips_}) values->resize(rows.size());
}

// force_of(row number): on the second side.
template <class Real>
template <class ForceOf>
void StepSystem<Real>::find_row_forces(const ForceOf& force_of) {
    for_each_index(rows.size(), [&](std::size_t r) { row_forces_[r] = force_of(r); });
}

// What they add to the forces on a node.
template <class Real>
Vec3<Real> StepSystem<Real>::of_rows(std::uint32_t node) const {
    Vec3<Real> sum(0);
    for (std::uint32_t e = row_starts_[node]; e < row_starts_[node + 1]; ++e) {
        const std::uint32_t entry = row_entries_[e];
        sum += rows[entry / 4].weights[entry % 4] * row_forces_[entry / 4];
    }
    return sum;
}

template <class Real>
void StepSystem<Real>::find_base_residual() {
    ++counts.products;
    for_each_index(displacements.size(),
                   [&](std::size_t n) { elastic.displacements[n] = Vec4<Real>(displacements[n], 0); });
    elastic.begin_product();
    awake_.for_each_piece([&](const Range& nodes) {
        elastic.multiply(nodes, product_);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            base_[n] = inertia[n] > Real(0) ? loads[n] - (product_[n] + inertia[n] * displacements[n])
                                            : Vec3<Real>(0);
    });
}

template <class Real>
std::vector<Vec3<Real>> StepSystem<Real>::elastic_forces() {
    for_each_index(displacements.size(),
                   [&](std::size_t n) { elastic.displacements[n] = Vec4<Real>(displacements[n], 0); });
    elastic.begin_product();
    Field forces(displacements.size());
    pieces_.for_each_piece([&](const Range& nodes) {
        elastic.multiply(nodes, forces);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) forces[n] = elastic.forces()[n] - forces[n];
    });
    return forces;
}

template <class Real>
void StepSystem<Real>::find_slips() {
    for_each_index(rows.size(), [&](std::size_t r) { slips_[r] = relative<Real>(rows[r], displacements); });
}

template <class Real>
void StepSystem<Real>::find_tangents() {
    for_each_index(rows.size(), [&](std::size_t r) { tangents_[r] = tangent(rows[r], slips_[r]); });
}

// In place of tangents, for a first step that closes gaps: from the gap at the start to the one expected.
template <class Real>
void StepSystem<Real>::find_chords(std::span<const Vec3<Real>> expected) {
    for_each_index(rows.size(), [&](std::size_t r) {
        const ContactRow<Real>& row = rows[r];
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
void StepSystem<Real>::set_limits() {
    for_each_index(rows.size(),
                   [&](std::size_t r) { rows[r].limit = rows[r].friction * rows[r].pressing(slips_[r]); });
}

template <class Real>
void StepSystem<Real>::prepare_preconditioner(bool only_rows) {
    awake_.for_each([&](std::uint32_t n) {
        const bool has_rows = row_starts_[n] < row_starts_[n + 1];
        if (inertia[n] == Real(0) || (only_rows && !has_rows)) return;
        SymmetricMatrix<Real> block = elastic.diagonal()[n];
        block.add_identity(inertia[n]);
        for (std::uint32_t e = row_starts_[n]; e < row_starts_[n + 1]; ++e) {
            const std::uint32_t entry = row_entries_[e];
            const Real weight = rows[entry / 4].weights[entry % 4];
            const SymmetricMatrix<Real>& stiffness = tangents_[entry / 4].stiffness;
            block.diagonal += weight * weight * stiffness.diagonal;
            block.beside += weight * weight * stiffness.beside;
        }
        inverse_blocks_[n] = inverse_of(block);
    });
    rigid.factorise(tangents_);
}

// z = M^-1 r: z_ by nodes' blocks, and the rigid level. update(n): of free nodes, what residual_ becomes.
// @param is_enough output: whether no body may lack more of its least energy than it should @return r . z
template <class Real>
template <class Update>
double StepSystem<Real>::precondition(const Update& update, bool& is_enough) {
    struct Part {
        double lack = 0.0;  // r . z
        glm::dvec3 force{0.0}, moment{0.0};
    };
    std::vector<Part> parts(model_->objects.size());
    awake_.gather(
        std::span<Part>(parts),
        [&](const ObjectPieces::Piece& piece) {
            Part part;
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                if (inertia[n] == Real(0)) continue;
                const Vec3<Real> r = update(n), z = inverse_blocks_[n] * r;
                residual_[n] = r;
                z_[n] = z;
                part.lack += static_cast<double>(glm::dot(r, z));
                const glm::dvec3 force(r);
                part.force += force;
                part.moment += glm::cross(glm::dvec3(rigid.arm(n)), force);
            }
            return part;
        },
        [](Part& sum, const Part& more) {
            sum.lack += more.lack;
            sum.force += more.force;
            sum.moment += more.moment;
        });
    std::vector<Motion> forces(rigid.count());
    for (std::size_t b = 0; b < forces.size(); ++b)
        forces[b] = motion(parts[rigid.object(b)].force, parts[rigid.object(b)].moment);
    rigid_z_ = forces;
    rigid.solve(rigid_z_);
    is_enough = true;
    double sum = 0.0;
    for (std::size_t o = 0; o < parts.size(); ++o) {
        double lack = parts[o].lack;
        if (rigid.is_free(o)) lack += forces[rigid.number(o)].dot(rigid_z_[rigid.number(o)]);
        is_enough = is_enough && lack <= enough[o];
        sum += lack;
    }
    return sum;
}

// product_ = A p, rows among it. @return p . A p
template <class Real>
double StepSystem<Real>::multiply_direction() {
    ++counts.products;
    const std::vector<Vec4<Real>>& p = elastic.displacements;
    find_row_forces([&](std::size_t r) { return tangents_[r].stiffness * relative<Real>(rows[r], p); });
    elastic.begin_product();
    return awake_.sum([&](const ObjectPieces::Piece& piece) {
        elastic.multiply(piece.range, product_);
        double sum = 0.0;
        for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
            if (inertia[n] == Real(0)) continue;
            const Vec3<Real> d(p[n]), all = product_[n] + inertia[n] * d + of_rows(n);
            product_[n] = all;
            sum += static_cast<double>(glm::dot(d, all));
        }
        return sum;
    });
}

// From no step, with the linear residual in residual_. A step makes one iteration at least: what elements
// exert counts, however short it is.
// @param forcing part of what is lacking at first that may be left @return iterations
template <class Real>
int StepSystem<Real>::conjugate_gradients(int count, double forcing) {
    bool is_enough = false;
    double rz = precondition(
        [&](std::uint32_t n) {
            step_[n] = Vec3<Real>(0);
            return residual_[n];
        },
        is_enough);
    const double enough_of_all = forcing * rz;
    std::vector<Vec4<Real>>& p = elastic.displacements;
    for_each_index(p.size(), [&](std::size_t n) { p[n] = Vec4<Real>(0); });
    Real b = 0;
    int k = 0;
    while (k < count && ((!is_enough && rz > enough_of_all) || (counts.iterations == 0 && rz > 0.0))) {
        rigid.for_displacements(awake_, rigid_z_, [&](std::size_t n, const Vec3<Real>& rigid_part) {
            if (inertia[n] > Real(0)) p[n] = Vec4<Real>(z_[n] + rigid_part + b * Vec3<Real>(p[n]), 0);
        });
        ++counts.iterations;
        const double curvature = multiply_direction();
        if (!(curvature > 0.0)) return k;
        ++k;
        const auto a = static_cast<Real>(rz / curvature);
        const double next = precondition(
            [&](std::uint32_t n) {
                step_[n] += a * Vec3<Real>(p[n]);
                return residual_[n] - a * product_[n];
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
double StepSystem<Real>::line_search(std::span<const Vec3<Real>> changes, double base, double curvature) {
    std::vector<double> sums((rows.size() + kChunk - 1) / kChunk);
    const auto fall = [&](double t) {  // minus the slope
        for_each_index(0, sums.size(), 1, [&](std::size_t c) {
            double sum = 0.0;
            for (std::size_t r = c * kChunk; r < std::min(rows.size(), (c + 1) * kChunk); ++r) {
                const Vec3<Real> force = rows[r].force(slips_[r] + static_cast<Real>(t) * changes[r]);
                sum += static_cast<double>(glm::dot(changes[r], force));
            }
            sums[c] = sum;
        });
        return std::accumulate(sums.begin(), sums.end(), base - t * curvature);
    };
    const double first = fall(0.0);
    if (!(first > 0.0)) return 0.0;
    if (fall(1.0) >= -tuning::kTurned * first) return 1.0;
    ++counts.line_searches;
    double low = 0.0, high = 1.0;
    for (int k = 0; k < tuning::kMostRounds; ++k) {
        const double middle = 0.5 * (low + high);
        (fall(middle) > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// Whether what is left of all forces on each body is no more than a part of what presses it.
template <class Real>
bool StepSystem<Real>::is_balanced(double tolerance, std::span<const Motion> forces) const {
    std::vector<double> pressing(rigid.count(), 0.0);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const auto force = static_cast<double>(rows[r].pressing(slips_[r]));
        for (const std::uint32_t object : {rows[r].object, rows[r].other})
            if (object != kNoNode && rigid.is_free(object)) pressing[rigid.number(object)] += force;
    }
    const double gravity = glm::length(glm::dvec3(model_->gravity));
    for (std::size_t o = 0; o < model_->body_count(); ++o) {
        if (!rigid.is_free(o)) continue;
        const std::uint32_t b = rigid.number(o);
        if (!(pressing[b] > 0.0)) continue;
        const double weight = gravity * model_->objects[o].mass;
        const double scale =
            weight > 0.0 ? std::min(pressing[b], 2.0 * weight) + 0.05 * pressing[b] : pressing[b];
        if (forces[b].template head<3>().norm() > tolerance * scale) return false;
    }
    return true;
}

// Newton's method on rigid motions alone, in which only their forces and rows count. The limits of
// friction stay as they are until bodies are nearly in balance (Tresca's friction), since what presses before
// that has little to do with what will.
template <class Real>
void StepSystem<Real>::rigid_newton() {
    if (rigid.is_empty()) return;
    std::vector<Motion> base = rigid.gather(base_), moved(rigid.count(), Motion::Zero());
    std::vector<Vec3<Real>> changes(rows.size());
    const auto forces = [&] {
        find_row_forces([&](std::size_t r) { return rows[r].force(slips_[r]); });
        std::vector<Motion> sums = base;
        rigid.add_rows(row_forces_, sums);
        return sums;
    };
    for (int k = 0; k < tuning::kMostRounds; ++k) {
        std::vector<Motion> step = forces();
        if (is_balanced(tuning::kNearBalance, step)) {
            set_limits();
            step = forces();
            if (k > 0 && is_balanced(tuning::kBalance, step)) break;
        }
        ++counts.rigid_rounds;
        find_tangents();
        rigid.factorise(tangents_);
        rigid.solve(step);
        for_each_index(rows.size(), [&](std::size_t r) { changes[r] = rigid.relative(r, step); });
        const std::vector<Motion> resistance = rigid.resistance(step);
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
        for_each_index(rows.size(),
                       [&](std::size_t r) { slips_[r] += static_cast<Real>(part) * changes[r]; });
    }
    rigid.for_displacements(awake_, moved,
                            [&](std::size_t n, const Vec3<Real>& d) { displacements[n] += d; });
}

// A Newton step on all nodes, from the tangents that are set. @param is_first of this system
// @return whether there was any to make
template <class Real>
bool StepSystem<Real>::newton_step(int most_iterations, double forcing, bool is_first) {
    prepare_preconditioner(!is_first);
    find_row_forces([&](std::size_t r) { return tangents_[r].force(slips_[r]); });
    awake_.for_each([&](std::uint32_t n) {
        residual_[n] = inertia[n] > Real(0) ? base_[n] + of_rows(n) : Vec3<Real>(0);
    });
    if (conjugate_gradients(most_iterations, forcing) == 0) return false;
    // A times the step, without rows: what the residual lost, less what rows did.
    std::vector<Vec3<Real>> changes(rows.size());
    find_row_forces([&](std::size_t r) {
        changes[r] = relative<Real>(rows[r], step_);
        return tangents_[r].force(slips_[r]) - tangents_[r].stiffness * changes[r];
    });
    const std::vector<glm::dvec2> sums = awake_.sums<glm::dvec2>([&](std::uint32_t n) {
        if (inertia[n] == Real(0)) return glm::dvec2(0.0);
        const Vec3<Real> step = step_[n], resists = base_[n] + of_rows(n) - residual_[n];
        product_[n] = resists;
        return glm::dvec2(glm::dot(step, base_[n]), glm::dot(step, resists));
    });
    const glm::dvec2 sum = std::accumulate(sums.begin(), sums.end(), glm::dvec2(0.0));
    const auto part = static_cast<Real>(rows.empty() ? 1.0 : line_search(changes, sum.x, sum.y));
    awake_.for_each([&](std::uint32_t n) {
        if (inertia[n] == Real(0)) return;
        displacements[n] += part * step_[n];
        base_[n] -= part * product_[n];
    });
    find_slips();
    return true;
}

template <class Real>
void StepSystem<Real>::solve() {
    counts = {};
    index_rows();
    rigid.set_rows(rows);
    find_slips();
    const std::vector<Vec3<Real>> expected = slips_;
    if (!rows.empty()) {  // elements hardly resist rigid motions
        awake_.for_each([&](std::uint32_t n) { base_[n] = loads[n] - inertia[n] * displacements[n]; });
        rigid_newton();
    }
    find_base_residual();
    find_chords(expected);
    if (rows.empty()) {
        newton_step(2 * iterations, 0.0, true);
    } else {
        for (int k = 0; k < tuning::kMostLinearisations && newton_step(iterations, tuning::kForcing, k == 0);
             ++k)
            find_tangents();
    }
    rigid_newton();
}

template class StepSystem<float>;
template class StepSystem<double>;

}  // namespace gelatin::cpu
