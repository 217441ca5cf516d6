#include "gpu/descent/block_descent.h"

namespace gelatin::gpu {
namespace {

gl::Defines start_defines(const Model& model) {
    gl::Defines defines = ModelBuffers::collider_defines(model);
    if (!model.loads.empty()) defines.emplace_back("LOADED");
    return defines;
}

}  // namespace

BlockDescent::BlockDescent(const Model& model, const DescentSettings& settings)
    : settings_(settings),
      node_count_(model.node_count()),
      tet_count_(static_cast<std::uint32_t>(model.tets.size())),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      start_program_(gl::Program::compute("sim/descent/start_descent.comp", start_defines(model))),
      find_tangled_program_(gl::Program::compute("sim/descent/take_back_tangled.comp", {"TETS"})),
      take_back_program_(gl::Program::compute("sim/descent/take_back_tangled.comp")),
      sweep_program_(gl::Program::compute("sim/descent/descend.comp", StepObjective::defines(model))),
      node_objects_(objects_of_nodes(model), gl::TexelFormat::r32ui),
      is_tangled_(model.objects.size()),
      objective_(model),
      contacts_(model),
      rigid_move_(model, objective_, contacts_) {
    if (settings_.coarse_level) {
        const CoarseBasis basis = make_coarse_basis(model);
        if (basis.cluster_count() > 0) coarse_.emplace(model, basis, objective_, contacts_);
    }
    bind_buffers();
}

// What never changes.
void BlockDescent::bind_buffers() const {
    start_program_.bind("NearFlat", objective_.near_flat);
    start_program_.bind("Tangled", is_tangled_);
    start_program_.bind("Starts", objective_.starts);
    start_program_.bind("Targets", objective_.targets);
    contacts_.bind(start_program_);
    find_tangled_program_.bind("tets", objective_.tets);
    find_tangled_program_.bind("tet_rests", objective_.tet_rests);
    take_back_program_.bind("start_positions", objective_.start_texels);
    for (const gl::Program* program : {&find_tangled_program_, &take_back_program_}) {
        program->bind("node_objects", node_objects_);
        program->bind("Tangled", is_tangled_);
    }
    objective_.bind(sweep_program_);
    contacts_.bind(sweep_program_);
}

void BlockDescent::run(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
                       const NodeBuffers& current, double step, bool has_earlier, StageTimer* timer) {
    const auto run_part = [&](const char* name, const auto& work) {
        const TimedStage part(timer, name);
        work();
    };
    run_part("advance_nodes.start", [&] {
        start(model, loads, previous, current, step, has_earlier);
        objective_.begin(previous, current, step);
        take_back_tangled(current);
        begin_moves(model, previous, current, step);
    });
    for (int i = 0; i < settings_.iterations; ++i) {
        if (i % kSweepsAMotion == 0)
            run_part("advance_nodes.update_tets", [&] { objective_.update(gathering_programs()); });
        run_part("advance_nodes.descend", [&] { sweep(); });
        const bool is_last = i + 1 == settings_.iterations;
        if (coarse_ && !is_last && i % kSweepsACorrection == 0)
            run_part("advance_nodes.correct", [&] { coarse_->run(current, rigid_move_); });
        if (is_last || (i + 1) % kSweepsAMotion == 0)
            run_part("advance_nodes.move_bodies", [&] { rigid_move_.run(is_last); });
    }
}

std::vector<const gl::Program*> BlockDescent::gathering_programs() const {
    std::vector<const gl::Program*> programs = {&sweep_program_};
    if (coarse_) programs.push_back(&coarse_->force_program());
    return programs;
}

void BlockDescent::start(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
                         const NodeBuffers& current, double step, bool has_earlier) const {
    start_program_.bind("start_positions", previous.position_texels);
    start_program_.bind("start_velocities", previous.velocity_texels);
    start_program_.bind("Positions", current.positions);
    start_program_.bind("EarlierVelocities", current.velocities);
    model.bind_colliders(start_program_);
    model.pulls.bind(start_program_);
    if (loads != nullptr) loads->bind(start_program_);
    start_program_.set("time_step", static_cast<float>(step));
    start_program_.set("gravity", model.gravity);
    start_program_.set("node_count", node_count_);
    start_program_.set("object_count", object_count_);
    start_program_.set("has_earlier", has_earlier ? 1u : 0u);
    start_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

void BlockDescent::take_back_tangled(const NodeBuffers& current) const {
    find_tangled_program_.bind("positions", current.position_texels);
    find_tangled_program_.set("element_count", tet_count_);
    find_tangled_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage);

    take_back_program_.bind("Positions", current.positions);
    take_back_program_.set("element_count", node_count_);
    take_back_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

// The nodes' two buffers swap places from step to step.
void BlockDescent::begin_moves(const ModelBuffers& model, const NodeBuffers& previous,
                               const NodeBuffers& current, double step) {
    sweep_program_.bind("positions", current.position_texels);
    sweep_program_.bind("start_velocities", previous.velocity_texels);
    sweep_program_.bind("OutPositions", current.positions);
    sweep_program_.set("time_step", static_cast<float>(step));
    model.bind_colliders(sweep_program_);
    rigid_move_.begin(model, previous, current, step);
    if (coarse_) coarse_->begin(model, previous, current, step);
}

// One colour after another.
void BlockDescent::sweep() const {
    for (const Range& rows : objective_.colors()) {
        sweep_program_.set("first_row", rows.first);
        sweep_program_.set("row_count", rows.count);
        sweep_program_.dispatch(rows.count);
        gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
    }
}

}  // namespace gelatin::gpu
