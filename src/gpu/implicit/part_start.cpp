#include "gpu/implicit/part_start.h"

#include <cassert>

#include "core/stage.h"
#include "model/elasticity/wave_times.h"

namespace gelatin::gpu {
namespace {

std::vector<float> wave_times_of(const Model& model) {
    const std::vector<double> times = wave_times(model);
    return {times.begin(), times.end()};
}

gl::Defines pair_defines(bool has_pairs) {
    return has_pairs ? gl::Defines{"PAIRS"} : gl::Defines{};
}

}  // namespace

PartStart::Programs::Programs(const Model& model, bool planes, bool has_pairs)
    : begin_step(gl::Program::compute("sim/implicit/begin_step.comp")),
      end_step(gl::Program::compute("sim/implicit/end_step.comp")),
      begin_try(gl::Program::compute("sim/implicit/begin_try.comp")),
      predict(gl::Program::compute("sim/implicit/predict.comp", SumLoads::defines(model))),
      sum_bodies(gl::Program::compute("sim/implicit/sum_bodies.comp", pair_defines(has_pairs))),
      find_targets(gl::Program::compute("sim/implicit/find_targets.comp", SumLoads::defines(model))),
      find_enough(gl::Program::compute("sim/implicit/find_enough.comp")),
      sum_motions(gl::Program::compute("sim/implicit/sum_motions.comp")),
      follow_rotation(gl::Program::compute("sim/implicit/follow_rotation.comp")),
      has_planes(planes) {
    if (!has_pairs) place_rows = gl::Program::compute("sim/implicit/place_rows.comp");
    if (!planes) return;
    gl::Defines kinds = ModelBuffers::collider_defines(model);
    count_rows = gl::Program::compute("sim/implicit/count_rows.comp", kinds);
    if (has_pairs) kinds.emplace_back("PAIRS");
    make_rows = gl::Program::compute("sim/implicit/make_rows.comp", kinds);
}

std::vector<const gl::Program*> PartStart::Programs::all() const {
    std::vector<const gl::Program*> all = {&begin_step,  &end_step,    &begin_try,
                                           &predict,     &sum_bodies,  &find_targets,
                                           &find_enough, &sum_motions, &follow_rotation};
    if (has_planes) all.insert(all.end(), {&count_rows, &make_rows});
    return all;
}

PartStart::PartStart(const Model& model, StepState& state, const StepSystem& system, PairRows* pairs)
    : state_(state),
      system_(system),
      pairs_(pairs),
      node_count_(model.node_count()),
      body_count_(static_cast<std::uint32_t>(model.body_count())),
      chunk_count_(system.buffers().chunk_count),
      has_loads_(!model.loads.empty()),
      programs_(model, !model.colliders.empty(), pairs != nullptr),
      wave_times_(wave_times_of(model), gl::TexelFormat::r32f),
      part_sums_(chunk_count_, gl::TexelFormat::rgba32f),
      chunk_rows_(chunk_count_, gl::TexelFormat::rgba32ui),
      body_rows_(body_count_, gl::TexelFormat::rgba32ui),
      damping_times_(node_count_, gl::TexelFormat::r32f),
      energies_(chunk_count_, gl::TexelFormat::r32f) {
    assert(system.capacity().rows > 0 ? system.capacity().pairs >= body_count_ : model.colliders.empty());
    assert(pairs == nullptr || system.capacity().rows > 0);
    bind_buffers();
}

void PartStart::bind_buffers() const {
    std::vector<const gl::Program*> all = programs_.all();
    if (pairs_ != nullptr) {
        for (const gl::Program* program : all) pairs_->bind(*program);
        const std::vector<const gl::Program*> of_pairs = pairs_->programs();
        all.insert(all.end(), of_pairs.begin(), of_pairs.end());
    } else {
        all.push_back(&programs_.place_rows);
    }
    for (const gl::Program* program : all) {
        system_.buffers().bind(*program);
        state_.bind(*program);
        program->bind_declared("positions", state_.from.position_texels);
        program->bind_declared("velocities", state_.from.velocity_texels);
        program->bind_declared("Positions", state_.from.positions);
        program->bind_declared("Velocities", state_.from.velocities);
        program->bind_declared("wave_times", wave_times_);
        part_sums_.bind(*program, "PartSums", "part_sums");
        chunk_rows_.bind(*program, "RowsOfChunks", "chunk_rows");
        body_rows_.bind(*program, "RowsOfBodies", "body_rows");
        program->bind_declared("DampingTimes", damping_times_.values);
        program->bind_declared("Energies", energies_.values);
        program->bind_declared("ElasticForces", system_.elastic.forces());
        program->set("row_capacity", static_cast<std::uint32_t>(system_.capacity().rows));
        program->set("node_count", node_count_);
    }
}

void PartStart::run(const gl::Program& program, std::uint32_t groups) const {
    state_.tries.run(Tries::Where::makes_part, program, groups);
}

// Whatever the clock says.
void PartStart::run_always(const gl::Program& program, std::uint32_t groups) const {
    program.dispatch_groups(groups);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch | gl::Barrier::command);
}

void PartStart::begin_step(const NodeBuffers& nodes, const StepStart& step) const {
    programs_.begin_step.bind("given_positions", nodes.position_texels);
    programs_.begin_step.bind("given_velocities", nodes.velocity_texels);
    programs_.begin_step.set("keeps_held", step.is_next && pairs_ != nullptr ? 1u : 0u);
    programs_.begin_step.set("size", static_cast<float>(step.size));
    programs_.begin_step.set("divides", step.divides ? 1u : 0u);
    programs_.begin_step.set("is_driven", step.is_driven ? 1u : 0u);
    programs_.begin_try.set("sleeps", step.sleeps ? 1u : 0u);
    run_always(programs_.begin_step, (node_count_ + 63) / 64);
}

void PartStart::end_step(const NodeBuffers& nodes) const {
    programs_.end_step.bind("given_velocities", nodes.velocity_texels);
    run_always(programs_.end_step, (node_count_ + 63) / 64);
}

void PartStart::run(const ModelBuffers& model, const SumLoads* loads, StageTimer* timer) const {
    {
        const Stage part(timer, "advance_nodes.detect");
        predict(model, loads);
        find_rows(model, loads);
    }
    const Stage part(timer, "advance_nodes.linearise");
    linearise(model, loads);
}

void PartStart::predict(const ModelBuffers& model, const SumLoads* loads) const {
    assert((loads != nullptr) == has_loads_);
    if (loads != nullptr) loads->bind(programs_.predict);
    programs_.predict.set("gravity", model.gravity);
    run_always(programs_.begin_try, 1);
    run(programs_.predict, chunk_count_);
}

void PartStart::linearise(const ModelBuffers& model, const SumLoads* loads) const {
    const Programs& p = programs_;
    if (loads != nullptr) loads->bind(p.find_targets);
    p.find_targets.set("gravity", model.gravity);
    model.pulls.bind(p.find_targets);
    run(p.find_targets, chunk_count_);
    run(p.find_enough, body_count_);
    system_.elastic.linearise(model, state_.from, damping_times_.texels, state_.tries);
    system_.begin_bodies(state_.from);
    run(p.sum_motions, chunk_count_);
    run(p.follow_rotation, chunk_count_);
}

void PartStart::find_rows(const ModelBuffers& model, const SumLoads* loads) const {
    const Programs& p = programs_;
    const bool has_forces = loads != nullptr || model.pulls.is_acting();
    if (p.has_planes) {
        model.bind_colliders(p.count_rows);
        run(p.count_rows, chunk_count_);
    }
    if (pairs_ != nullptr) pairs_->weigh(model);
    p.sum_bodies.set("has_forces", has_forces ? 1u : 0u);
    run(p.sum_bodies, body_count_);
    if (pairs_ != nullptr) {
        pairs_->place(has_forces);
    } else {
        run(p.place_rows, 1);
    }
    if (p.has_planes) {
        model.bind_colliders(p.make_rows);
        run(p.make_rows, chunk_count_);
    }
    if (pairs_ != nullptr) pairs_->sort();
}

}  // namespace gelatin::gpu
