#include "cpu/explicit/explicit_solver.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <utility>

namespace gelatin::cpu {
namespace {

// Divides [0, count) into ranges for the threads; results never depend on the division.
template <class Work>
void for_ranges(std::uint32_t count, std::uint32_t grain, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, grain), [&](const auto& range) {
        work(Range{range.begin(), range.end() - range.begin()});
    });
}

constexpr std::uint32_t kSlicesATask = 8;
constexpr std::uint32_t kElementsATask = 2048;

std::uint32_t slice_count(const Model& model) {
    return static_cast<std::uint32_t>(model.half_springs.slice_starts.size() - 1);
}

// In float with SIMD; in double the plain reference, which needs no tables for that.
TetBlocks tets_for(const Nodes<float>&, const Model& model) {
    return make_pass_tets(model);
}
TetBlocks tets_for(const Nodes<double>&, const Model&) {
    return {};
}
void find_stresses(const Model& model, const TetBlocks& tets, const Nodes<float>& at,
                   std::span<float> stresses, Range slices) {
    find_volume_stresses_simd(model, tets, at, stresses, slices);
}
void find_stresses(const Model& model, const TetBlocks&, const Nodes<double>& at, std::span<double> stresses,
                   Range slices) {
    cpu::find_volume_stresses<double>(model, at, stresses, slices);
}
void advance(const Pass<float>& pass, const TetBlocks& tets, Range slices) {
    advance_nodes_simd(pass, tets, slices);
}
void advance(const Pass<double>& pass, const TetBlocks&, Range slices) {
    cpu::advance_nodes(pass, slices);
}

}  // namespace

template <class Real>
ExplicitSolver<Real>::ExplicitSolver(std::shared_ptr<const Model> model, SolverKind solver,
                                     ForceMethod forces, const CollisionSettings& collision)
    : CpuSolver<Real>(std::move(model), collision),
      scheme_(explicit_scheme(solver)),
      forces_(forces),
      pass_tets_(tets_for(current_, *model_)) {
    if (scheme_.pass_count > 1) sums_ = stage_[0] = stage_[1] = current_;
    if (forces_ == ForceMethod::divide_and_merge) {
        spring_forces_.resize(model_->springs.size());
        node_forces_.resize(model_->node_count());
    }
    if (!model_->volume_term.is_empty()) volume_stresses_.resize(model_->node_count());
}

template <class Real>
void ExplicitSolver<Real>::advance_nodes(const Step& step) {
    const bool is_pulled = this->acting_pulls() != nullptr;
    if (is_pulled && load_forces_.empty()) load_forces_.assign(model_->node_count(), Vec4<Real>(0));
    const Nodes<Real>* from = &current_;
    for (int p = 0; p < scheme_.pass_count; ++p) {
        Nodes<Real>& to = p + 1 == scheme_.pass_count ? previous_ : stage_[p % 2];
        this->sum_loads(step, *from);
        add_pulls(*from, static_cast<Real>(step.size));
        find_volume_stresses(*from);
        Pass<Real> pass = make_pass(*model_, scheme_, p, step.size, current_, *from, to, sums_);
        if (!load_forces_.empty()) pass.load_forces = load_forces_.data();
        if (!volume_stresses_.empty()) pass.volume_stresses = volume_stresses_.data();
        run_pass(pass);
        for (const std::uint32_t n : pulls_.nodes()) load_forces_[n] = Vec4<Real>(0);
        from = &to;
    }
    std::swap(current_, previous_);
}

// Pulls are loads of the nodes that they hold, as long as the pass takes.
template <class Real>
void ExplicitSolver<Real>::add_pulls(const Nodes<Real>& nodes, Real step) {
    for (const std::uint32_t n : pulls_.nodes()) {
        const Vec3<Real> velocity(nodes.velocities[n]);
        load_forces_[n] += Vec4<Real>(pulls_.force(n, nodes.positions[n], velocity, step), 0);
    }
}

template <class Real>
void ExplicitSolver<Real>::find_volume_stresses(const Nodes<Real>& nodes) {
    if (volume_stresses_.empty()) return;
    for_ranges(slice_count(*model_), kSlicesATask,
               [&](Range slices) { find_stresses(*model_, pass_tets_, nodes, volume_stresses_, slices); });
}

template <class Real>
void ExplicitSolver<Real>::run_pass(const Pass<Real>& pass) {
    const std::uint32_t nodes = model_->node_count();
    if (forces_ == ForceMethod::fused) {
        for_ranges(slice_count(*model_), kSlicesATask,
                   [&](Range slices) { cpu::advance(pass, pass_tets_, slices); });
        return;
    }
    for_ranges(static_cast<std::uint32_t>(model_->springs.size()), kElementsATask,
               [&](Range range) { write_spring_forces<Real>(pass, spring_forces_, range); });
    for_ranges(nodes, kElementsATask,
               [&](Range range) { merge_spring_forces<Real>(*model_, spring_forces_, node_forces_, range); });
    for_ranges(nodes, kElementsATask, [&](Range range) { integrate_nodes<Real>(pass, node_forces_, range); });
}

template class ExplicitSolver<float>;
template class ExplicitSolver<double>;

}  // namespace gelatin::cpu
