#include "support/step_on_gpu.h"

#include <optional>

#include "gpu/drive/sum_loads.h"
#include "gpu/elasticity/find_volume_stresses.h"
#include "gpu/explicit/advance_nodes.h"
#include "gpu/explicit/divide_and_merge.h"
#include "support/parity.h"

namespace gelatin::test {

NodeArrays step_on_gpu(const Model& model, SolverKind solver, ForceMethod forces, double step) {
    const ExplicitScheme& scheme = explicit_scheme(solver);
    const std::vector<glm::vec4> poison = poisoned(model.node_count());
    const gpu::ModelBuffers buffers(model);
    const gpu::NodeBuffers start(model.positions, model.velocities);
    gpu::NodeBuffers stage[2] = {{poison, poison}, {poison, poison}}, sums(poison, poison),
                     result(poison, poison);

    const gpu::AdvanceNodes fused(model, scheme);
    const gpu::DivideAndMerge divided(model, scheme);
    std::optional<gpu::SumLoads> loads;
    if (!model.loads.empty()) loads.emplace(model);
    std::optional<gpu::FindVolumeStresses> stresses;
    if (!model.volume_term.is_empty()) stresses.emplace(model);
    const gpu::NodeBuffers* from = &start;
    for (int p = 0; p < scheme.pass_count; ++p) {
        gpu::NodeBuffers& to = p + 1 == scheme.pass_count ? result : stage[p % 2];
        if (loads) loads->run(*from);
        if (stresses) stresses->run(buffers, *from);
        const gpu::Pass pass{scheme,
                             p,
                             step,
                             start,
                             *from,
                             to,
                             sums,
                             loads ? &*loads : nullptr,
                             stresses ? &*stresses : nullptr};
        if (forces == ForceMethod::fused) {
            fused.run(buffers, pass);
        } else {
            divided.run(buffers, pass);
        }
        from = &to;
    }
    gl::barrier(gl::Barrier::buffer_update);
    NodeArrays arrays{poison, poison};
    result.positions.download(arrays.positions);
    result.velocities.download(arrays.velocities);
    return arrays;
}

}  // namespace gelatin::test
