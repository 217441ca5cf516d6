#include "gpu/explicit/explicit_solver.h"

#include <utility>

namespace gelatin::gpu {

ExplicitSolver::ExplicitSolver(std::shared_ptr<const Model> model, SolverKind solver, ForceMethod forces,
                               const CollisionSettings& collision)
    : GpuSolver(std::move(model), collision),
      scheme_(explicit_scheme(solver)),
      kernels_(make_kernels(*model_, scheme_, forces)) {
    if (scheme_.pass_count > 1) {
        for (NodeBuffers* nodes : {&stage_[0], &stage_[1], &sums_})
            *nodes = NodeBuffers(model_->positions, model_->velocities);
    }
    if (!model_->volume_term.is_empty()) find_volume_stresses_.emplace(*model_);
}

ExplicitSolver::Kernels ExplicitSolver::make_kernels(const Model& model, const ExplicitScheme& scheme,
                                                     ForceMethod forces) {
    if (forces == ForceMethod::fused) return AdvanceNodes(model, scheme);
    return DivideAndMerge(model, scheme);
}

void ExplicitSolver::advance_nodes(const Step& step) {
    const SumLoads* const loads = loads_of(step);
    const FindVolumeStresses* const stresses = find_volume_stresses_ ? &*find_volume_stresses_ : nullptr;
    const NodeBuffers* from = &current_;
    for (int p = 0; p < scheme_.pass_count; ++p) {
        NodeBuffers& to = p + 1 == scheme_.pass_count ? previous_ : stage_[p % 2];
        if (loads != nullptr) loads->run(*from);
        if (stresses != nullptr) stresses->run(buffers_, *from);
        const Pass pass{scheme_, p, step.size, current_, *from, to, sums_, loads, stresses};
        std::visit([&](const auto& kernels) { kernels.run(buffers_, pass); }, kernels_);
        from = &to;
    }
    std::swap(current_, previous_);
}

}  // namespace gelatin::gpu
