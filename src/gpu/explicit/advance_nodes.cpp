#include "gpu/explicit/advance_nodes.h"

namespace gelatin::gpu {

void AdvanceNodes::run(const ModelBuffers& model, const Pass& pass) const {
    bind_integration(program_, model, pass);
    model.bind_half_springs(program_);
    program_.dispatch(model.node_count);
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
