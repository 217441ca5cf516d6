#include "gpu/implicit/step_system.h"

#include <algorithm>

#include "gpu/chunks.h"

namespace gelatin::gpu {

StepSystem::StepSystem(const Model& model)
    : elastic(model),
      loads(model.positions.size()),
      displacements(model.positions.size()),
      enough(model.objects.size()),
      sum_program_(gl::Program::compute("sim/implicit/solve_bodies.comp")),
      body_program_(gl::Program::compute("sim/implicit/solve_bodies.comp", {"OBJECTS"})),
      begin_program_(gl::Program::compute("sim/implicit/solve_residual.comp", {"BEGIN"})),
      residual_program_(gl::Program::compute("sim/implicit/solve_residual.comp")),
      direction_program_(gl::Program::compute("sim/implicit/solve_direction.comp")),
      product_program_(gl::Program::compute("sim/implicit/solve_product.comp")),
      finish_program_(gl::Program::compute("sim/implicit/solve_direction.comp", {"FINISH"})),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      bodies_(model.objects.size()),
      states_(2 * model.objects.size()),
      steps_(model.positions.size()),
      residuals_(model.positions.size()),
      preconditioned_(model.positions.size()),
      products_(model.positions.size()) {
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);
    chunk_count_ = static_cast<std::uint32_t>(chunks.size());
    chunks_ = {chunks, gl::TexelFormat::rgba32ui};
    chunk_starts_ = {chunk_starts(chunks, model.objects.size()), gl::TexelFormat::r32ui};
    body_sums_ = gl::Buffer<StepBodySums>(chunks.size());
    sums_ = gl::Buffer<ResidualSums>(chunks.size());
    curvatures_ = gl::Buffer<float>(chunks.size());
    load_texels_ = {loads, gl::TexelFormat::rgba32f};
    displacement_texels_ = {displacements, gl::TexelFormat::rgba32f};
    enough_texels_ = {enough, gl::TexelFormat::r32f};
    body_texels_ = {bodies_, gl::TexelFormat::rgba32f};
    step_texels_ = {steps_, gl::TexelFormat::rgba32f};
    preconditioned_texels_ = {preconditioned_, gl::TexelFormat::rgba32f};
    product_texels_ = {products_, gl::TexelFormat::rgba32f};
    bind_buffers();
}

// What never changes.
void StepSystem::bind_buffers() const {
    for (const gl::Program* program : {&sum_program_, &body_program_, &begin_program_, &residual_program_,
                                       &direction_program_, &product_program_, &finish_program_}) {
        program->bind("chunks", chunks_);
        program->set("chunk_count", chunk_count_);
        program->set("object_count", object_count_);
    }
    for (const gl::Program* program : {&sum_program_, &begin_program_, &residual_program_,
                                       &direction_program_, &product_program_, &finish_program_})
        program->bind("loads", load_texels_);
    for (const gl::Program* program :
         {&begin_program_, &residual_program_, &direction_program_, &finish_program_}) {
        program->bind("bodies", body_texels_);
        program->bind("Sums", sums_);
    }
    for (const gl::Program* program : {&begin_program_, &residual_program_}) {
        program->bind("blocks", elastic.block_texels());
        program->bind("Steps", steps_);
        program->bind("Residuals", residuals_);
        program->bind("Preconditioned", preconditioned_);
    }
    for (const gl::Program* program : {&residual_program_, &direction_program_, &product_program_})
        program->bind("States", states_);
    for (const gl::Program* program : {&body_program_, &begin_program_, &residual_program_,
                                       &direction_program_, &product_program_, &finish_program_})
        program->bind("chunk_starts", chunk_starts_);
    for (const gl::Program* program : {&residual_program_, &product_program_})
        program->bind("Curvatures", curvatures_);
    sum_program_.bind("Sums", body_sums_);
    sum_program_.set("element_count", chunk_count_);
    body_program_.bind("Sums", body_sums_);
    body_program_.bind("Bodies", bodies_);
    body_program_.bind("enough", enough_texels_);
    body_program_.set("element_count", object_count_);
    elastic.bind_product(begin_program_, displacement_texels_);
    elastic.bind_product(product_program_, elastic.displacement_texels());
    residual_program_.bind("directions", elastic.displacement_texels());
    residual_program_.bind("products", product_texels_);
    product_program_.bind("Products", products_);
    direction_program_.bind("Directions", elastic.displacements);
    direction_program_.bind("preconditioned", preconditioned_texels_);
    finish_program_.bind("steps", step_texels_);
    finish_program_.bind("Displacements", displacements);
}

// A work group a chunk.
void StepSystem::dispatch(const gl::Program& program) const {
    program.dispatch_groups(chunk_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

void StepSystem::solve(const NodeBuffers& at) const {
    for (const gl::Program* program : {&sum_program_, &body_program_, &begin_program_, &residual_program_,
                                       &direction_program_, &finish_program_})
        program->bind("positions", at.position_texels);
    dispatch(sum_program_);
    body_program_.dispatch(object_count_);
    gl::barrier(gl::Barrier::texture_fetch);
    dispatch(begin_program_);
    const auto find_direction = [&](std::uint32_t turn, bool is_first) {
        direction_program_.set("turn", turn);
        direction_program_.set("is_first", is_first ? 1u : 0u);
        dispatch(direction_program_);
    };
    find_direction(1, true);
    for (int k = 0; k < 2 * iterations; ++k) {
        const auto turn = static_cast<std::uint32_t>(k % 2);
        for (const gl::Program* program : {&product_program_, &residual_program_}) {
            program->set("turn", turn);
            dispatch(*program);
        }
        find_direction(turn, false);
    }
    dispatch(finish_program_);
}

std::vector<SolveState> StepSystem::states() const {
    std::vector<SolveState> states(states_.size());
    gl::barrier(gl::Barrier::buffer_update);
    states_.download(states);
    states.resize(object_count_);  // after an even number of iterations
    return states;
}

}  // namespace gelatin::gpu
