#include "cpu/implicit/step_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// A body is nearly in balance where what is left of all forces on it is this part of what presses it: then
// the limits of friction are found anew. It is in balance below the second.
constexpr double kNearBalance = 0.1, kBalance = 1e-3;
// A chord of the law goes no nearer than to this part of the gap at the start.
constexpr double kLeastGap = 0.25;
// A step along a direction is shortened where the slope has turned by more than this part of that at its
// start.
constexpr double kTurned = 0.1;
constexpr std::size_t kChunk = 1024;  // of a sum

}  // namespace

template <class Real>
StepSystem<Real>::StepSystem(std::shared_ptr<const Model> model)
    : elastic(model),
      rigid(model),
      inertia(model->node_count()),
      loads(model->node_count()),
      displacements(model->node_count()),
      model_(std::move(model)),
      row_starts_(model_->node_count() + 1),
      blocks_(model_->node_count()) {
    for (Field* field : {&base_, &residual_, &direction_, &product_, &z_, &p_, &coarse_})
        field->resize(model_->node_count());
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
    row_forces_.resize(rows.size());
}

// force_of(row number): on the second side.
template <class Real>
template <class ForceOf>
void StepSystem<Real>::add_row_forces(const ForceOf& force_of, Field& sum) {
    if (rows.empty()) return;
    for_each_index(rows.size(), [&](std::size_t r) { row_forces_[r] = force_of(r); });
    for_each_index(sum.size(), [&](std::size_t n) {
        if (inertia[n] == Real(0)) return;
        for (std::uint32_t e = row_starts_[n]; e < row_starts_[n + 1]; ++e) {
            const std::uint32_t entry = row_entries_[e];
            sum[n] += rows[entry / 4].weights[entry % 4] * row_forces_[entry / 4];
        }
    });
}

template <class Real>
void StepSystem<Real>::multiply(const Field& d, Field& product) {
    ++counts.products;
    elastic.multiply(d, product);
    for_each_index(d.size(), [&](std::size_t n) {
        product[n] = inertia[n] > Real(0) ? product[n] + inertia[n] * d[n] : Vec3<Real>(0);
    });
}

template <class Real>
void StepSystem<Real>::multiply_with_rows(const Field& d, Field& product) {
    multiply(d, product);
    add_row_forces([&](std::size_t r) { return tangents_[r].stiffness * relative<Real>(rows[r], d); },
                   product);
}

template <class Real>
void StepSystem<Real>::find_base_residual() {
    multiply(displacements, product_);
    for_each_index(base_.size(), [&](std::size_t n) {
        base_[n] = inertia[n] > Real(0) ? loads[n] - product_[n] : Vec3<Real>(0);
    });
}

template <class Real>
void StepSystem<Real>::find_tangents() {
    for_each_index(rows.size(), [&](std::size_t r) {
        tangents_[r] = tangent(rows[r], relative<Real>(rows[r], displacements));
    });
}

// In place of tangents, for a first step that closes gaps: from the gap at the start to the one expected.
template <class Real>
void StepSystem<Real>::find_chords(const Field& expected) {
    for_each_index(rows.size(), [&](std::size_t r) {
        const ContactRow<Real>& row = rows[r];
        const Vec3<Real> s = relative<Real>(row, expected);
        RowTangent<Real> t;
        const Real there = row.gap_at(s);
        if (std::min(row.gap, there) < row.reach) {
            const Real from = std::min(row.gap, row.reach);
            const Real to = row.gap > Real(0) ? std::max(there, Real(kLeastGap) * from) : there;
            const Real force = row.force_of(from);
            Real slope = row.stiffness;
            if (to < from * Real(0.999999)) {
                slope = (row.force_of(to) - force) / (from - to);
            } else if (from < row.reach) {
                slope = row.slope_of(from);
            }
            t.constant = (force + slope * (from - row.gap)) * row.normal;
            t.stiffness.add_outer(slope, row.normal);
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
void StepSystem<Real>::find_true_residual() {
    residual_ = base_;
    add_row_forces([&](std::size_t r) { return rows[r].force(relative<Real>(rows[r], displacements)); },
                   residual_);
}

template <class Real>
void StepSystem<Real>::set_limits() {
    for_each_index(rows.size(), [&](std::size_t r) {
        ContactRow<Real>& row = rows[r];
        row.limit = row.friction * row.pressing(relative<Real>(row, displacements));
    });
}

// In chunks, so that it does not depend on the number of threads.
template <class Real>
double StepSystem<Real>::dot(const Field& a, const Field& b) const {
    std::vector<double> sums((a.size() + kChunk - 1) / kChunk);
    for_each_index(0, sums.size(), 1, [&](std::size_t c) {
        double sum = 0.0;
        const std::size_t end = std::min(a.size(), (c + 1) * kChunk);
        for (std::size_t n = c * kChunk; n < end; ++n) sum += static_cast<double>(glm::dot(a[n], b[n]));
        sums[c] = sum;
    });
    double sum = 0.0;
    for (const double s : sums) sum += s;
    return sum;
}

template <class Real>
void StepSystem<Real>::add(double factor, const Field& a, Field& sum) const {
    for_each_index(a.size(), [&](std::size_t n) { sum[n] += static_cast<Real>(factor) * a[n]; });
}

template <class Real>
void StepSystem<Real>::prepare_preconditioner() {
    for_each_index(blocks_.size(), [&](std::size_t n) {
        SymmetricMatrix<Real> block = elastic.diagonal()[n];
        block.add_identity(inertia[n]);
        for (std::uint32_t e = row_starts_[n]; e < row_starts_[n + 1]; ++e) {
            const std::uint32_t entry = row_entries_[e];
            const Real weight = rows[entry / 4].weights[entry % 4];
            const SymmetricMatrix<Real>& stiffness = tangents_[entry / 4].stiffness;
            block.diagonal += weight * weight * stiffness.diagonal;
            block.beside += weight * weight * stiffness.beside;
        }
        blocks_[n] = block;
    });
    rigid.factorise(rows, tangents_);
}

template <class Real>
void StepSystem<Real>::precondition(const Field& r, Field& z) {
    rigid.solve(r, coarse_);
    for_each_index(r.size(), [&](std::size_t n) {
        z[n] = inertia[n] > Real(0) ? cpu::solve(blocks_[n], r[n]) + coarse_[n] : Vec3<Real>(0);
    });
}

// From no direction, with the linear residual in residual_.
template <class Real>
void StepSystem<Real>::conjugate_gradients(int count) {
    std::fill(direction_.begin(), direction_.end(), Vec3<Real>(0));
    precondition(residual_, z_);
    p_ = z_;
    double rz = dot(residual_, z_);
    for (int k = 0; k < count && rz > enough; ++k) {
        ++counts.iterations;
        multiply_with_rows(p_, product_);
        const double curvature = dot(p_, product_);
        if (!(curvature > 0.0)) break;
        const double a = rz / curvature;
        add(a, p_, direction_);
        add(-a, product_, residual_);
        if (k + 1 == count) break;
        precondition(residual_, z_);
        const double next = dot(residual_, z_), b = next / rz;
        rz = next;
        for_each_index(p_.size(), [&](std::size_t n) { p_[n] = z_[n] + static_cast<Real>(b) * p_[n]; });
    }
}

// How far along direction_ the objective falls; product_ is A direction_.
template <class Real>
double StepSystem<Real>::line_search() {
    const double base = dot(direction_, base_), curvature = dot(direction_, product_);
    std::vector<std::pair<Vec3<Real>, Vec3<Real>>> states(rows.size());
    for_each_index(rows.size(), [&](std::size_t r) {
        states[r] = {relative<Real>(rows[r], displacements), relative<Real>(rows[r], direction_)};
    });
    const auto fall = [&](double t) {  // minus the slope
        double sum = base - t * curvature;
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const auto& [s, ds] = states[r];
            sum += static_cast<double>(glm::dot(ds, rows[r].force(s + static_cast<Real>(t) * ds)));
        }
        return sum;
    };
    const double first = fall(0.0);
    if (!(first > 0.0)) return 0.0;
    if (fall(1.0) >= -kTurned * first) return 1.0;
    ++counts.line_searches;
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 20; ++k) {
        const double middle = 0.5 * (low + high);
        (fall(middle) > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

template <class Real>
void StepSystem<Real>::step_along() {
    multiply(direction_, product_);
    const double part = line_search();
    add(part, direction_, displacements);
    add(-part, product_, base_);
}

template <class Real>
bool StepSystem<Real>::is_balanced(double tolerance) const {
    std::vector<double> pressing(rigid.count(), 0.0);
    for (const ContactRow<Real>& row : rows) {
        const auto force = static_cast<double>(row.pressing(relative<Real>(row, displacements)));
        for (const std::uint32_t object : {row.object, row.other})
            if (object != kNoNode && rigid.is_free(object)) pressing[rigid.number(object)] += force;
    }
    const std::vector<glm::dvec3> net = rigid.net_forces(residual_);
    const double gravity = glm::length(glm::dvec3(model_->gravity));
    for (std::size_t o = 0; o < model_->body_count(); ++o) {
        if (!rigid.is_free(o)) continue;
        const std::uint32_t b = rigid.number(o);
        if (!(pressing[b] > 0.0)) continue;
        const double weight = gravity * model_->objects[o].mass;
        const double scale =
            weight > 0.0 ? std::min(pressing[b], 2.0 * weight) + 0.05 * pressing[b] : pressing[b];
        if (glm::length(net[b]) > tolerance * scale) return false;
    }
    return true;
}

// The limits of friction stay as they are until bodies are nearly in balance (Tresca's friction), since what
// presses before that has little to do with what will.
template <class Real>
void StepSystem<Real>::rigid_newton() {
    if (rigid.is_empty()) return;
    for (int k = 0; k < most_rigid_rounds; ++k) {
        find_true_residual();
        if (is_balanced(kNearBalance)) {
            set_limits();
            find_true_residual();
            if (k > 0 && is_balanced(kBalance)) break;
        }
        find_tangents();
        ++counts.rigid_rounds;
        rigid.factorise(rows, tangents_);
        rigid.solve(residual_, direction_);
        step_along();
        if (rows.empty()) break;
    }
}

template <class Real>
void StepSystem<Real>::solve() {
    counts = {};
    index_rows();
    const Field expected = displacements;
    find_base_residual();
    rigid_newton();
    for (int k = 0; k < rounds; ++k) {
        if (k == 0) {
            find_chords(expected);
        } else {
            find_tangents();
        }
        prepare_preconditioner();
        residual_ = base_;
        add_row_forces(
            [&](std::size_t r) { return tangents_[r].force(relative<Real>(rows[r], displacements)); },
            residual_);
        conjugate_gradients(iterations * (k + 1) / rounds - iterations * k / rounds);
        step_along();
    }
    rigid_newton();
}

template class StepSystem<float>;
template class StepSystem<double>;

}  // namespace gelatin::cpu
