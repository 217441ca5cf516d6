#include "gpu/descent/step_objective.h"

#include "gpu/descent/descent_tables.h"
#include "model/elasticity/node_tets.h"
#include "model/elasticity/tet_strips.h"

namespace gelatin::gpu {
namespace {

gl::Defines volume_defines(const Model& model) {
    if (model.volume_term.is_empty()) return {};
    return {"VOLUME"};
}

}  // namespace

gl::Defines StepObjective::defines(const Model& model) {
    gl::Defines defines = ModelBuffers::collider_defines(model);
    if (model.has_damping()) defines.emplace_back("DAMPED");
    if (!model.neo_hookean_tets.empty()) defines.emplace_back("NEO_HOOKEAN");
    for (const std::string& define : volume_defines(model)) defines.push_back(define);
    return defines;
}

StepObjective::DampedSprings::DampedSprings(std::size_t pairs)
    : program(gl::Program::compute("sim/descent/damp_springs.comp")),
      springs(pairs),
      texels(springs, gl::TexelFormat::rgba32f) {
    program.bind("DampedSprings", springs);
}

StepObjective::Pressures::Pressures(const Model& model, std::span<const std::uint32_t> rows)
    : node_program(gl::Program::compute("sim/descent/find_pressures.comp", {"NODES"})),
      tet_program(gl::Program::compute("sim/descent/find_pressures.comp")),
      node_volumes(model.volume_term.nodes, gl::TexelFormat::rg32f),
      ratios(model.tets.size()),
      node_pressures(model.positions.size()),
      offsets(model.tets.size()) {
    const NodeTets by_node = make_node_tets(model.node_count(), model.tets);
    const StripSlices<VolumeStep> packed = pack_volume_strips({model, by_node}, rows_of_springs(model, rows));
    strips = {packed.steps, gl::TexelFormat::rgba32ui};
    strip_starts = {packed.slice_starts, gl::TexelFormat::r32ui};
    const VolumeShares shares = volume_shares_of(model, by_node);
    share_starts = {shares.slice_starts, gl::TexelFormat::r32ui};
    volume_shares = {shares.pairs, gl::TexelFormat::rgba32ui};
    ratio_texels = {ratios, gl::TexelFormat::r32f};
    node_pressure_texels = {node_pressures, gl::TexelFormat::r32f};
    offset_texels = {offsets, gl::TexelFormat::r32f};
}

StepObjective::StepObjective(const Model& model)
    : starts(model.positions.size()),
      targets(model.positions.size()),
      start_texels(starts, gl::TexelFormat::rgba32f),
      target_texels(targets, gl::TexelFormat::rgba32f),
      near_flat(model.positions.size()),
      tets(model.tets, gl::TexelFormat::rgba32ui),
      tet_rests(rests_of(model), gl::TexelFormat::rgba32f),
      mark_program_(gl::Program::compute("sim/descent/mark_flat_tets.comp", volume_defines(model))),
      node_count_(model.node_count()),
      tet_count_(static_cast<std::uint32_t>(model.tets.size())) {
    const DescentRows rows = make_descent_rows(model);
    const TetCorners corners = corners_of(model, rows.nodes);
    colors_ = rows.batches.front().colors;
    row_count_ = static_cast<std::uint32_t>(rows.nodes.size());
    rows_ = {rows_of(rows, model), gl::TexelFormat::rgba32ui};
    spring_ends_ = {ends_of(rows.springs), gl::TexelFormat::rg32ui};
    springs_ = {springs_of(rows.springs), gl::TexelFormat::rgba32f};
    spring_starts_ = {rows.springs.slice_starts, gl::TexelFormat::r32ui};
    tet_corners_ = {corners.corners, gl::TexelFormat::rgba32ui};
    corner_starts_ = {corners.slice_starts, gl::TexelFormat::r32ui};
    near_flat_texels_ = {near_flat, gl::TexelFormat::r32ui};
    neo_hookean_ = NeoHookeanBuffers(model, rows.nodes);
    if (model.has_damping()) damped_springs_.emplace(rows.springs.pairs.size());
    if (!model.volume_term.is_empty()) pressures_.emplace(model, rows.nodes);

    mark_program_.bind("tets", tets);
    mark_program_.bind("tet_rests", tet_rests);
    mark_program_.bind("NearFlat", near_flat);
    if (damped_springs_) bind_springs(damped_springs_->program);
    if (pressures_) bind_pressures();
}

void StepObjective::bind_pressures() const {
    mark_program_.bind("Ratios", pressures_->ratios);
    const gl::Program &node_program = pressures_->node_program, &tet_program = pressures_->tet_program;
    node_program.bind("ratios", pressures_->ratio_texels);
    node_program.bind("node_volumes", pressures_->node_volumes);
    node_program.bind("volume_shares", pressures_->volume_shares);
    node_program.bind("share_starts", pressures_->share_starts);
    node_program.bind("Pressures", pressures_->node_pressures);
    tet_program.bind("ratios", pressures_->ratio_texels);
    tet_program.bind("tets", tets);
    tet_program.bind("tet_rests", tet_rests);
    tet_program.bind("pressures", pressures_->node_pressure_texels);
    tet_program.bind("Offsets", pressures_->offsets);
}

void StepObjective::bind_springs(const gl::Program& program) const {
    program.bind("rows", rows_);
    program.bind("spring_ends", spring_ends_);
    program.bind("springs", springs_);
    program.bind("slice_starts", spring_starts_);
    program.bind("start_positions", start_texels);
}

void StepObjective::bind(const gl::Program& program) const {
    bind_springs(program);
    if (damped_springs_) program.bind("springs", damped_springs_->texels);
    program.bind("targets", target_texels);
    program.bind("near_flat", near_flat_texels_);
    program.bind("tet_corners", tet_corners_);
    program.bind("corner_starts", corner_starts_);
    program.bind("tet_rests", tet_rests);
    neo_hookean_.bind(program);
    if (!pressures_) return;
    program.bind("offsets", pressures_->offset_texels);
    program.bind("volume_strips", pressures_->strips);
    program.bind("volume_starts", pressures_->strip_starts);
}

void StepObjective::begin(const NodeBuffers& previous, const NodeBuffers& current, double step) {
    mark_ = 0;
    mark_program_.bind("positions", current.position_texels);
    if (!damped_springs_) return;
    const gl::Program& program = damped_springs_->program;
    program.bind("start_velocities", previous.velocity_texels);
    program.set("time_step", static_cast<float>(step));
    program.set("row_count", row_count_);
    program.dispatch(row_count_);
}

// Marks of earlier updates count no more.
void StepObjective::update(TetUpdate update, std::span<const gl::Program* const> programs) {
    if (update == TetUpdate::none) return;
    ++mark_;
    for (const gl::Program* program : programs) program->set("mark", mark_);
    mark_program_.set("mark", mark_);
    mark_program_.set("tet_count", tet_count_);
    mark_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
    if (!pressures_ || update != TetUpdate::all) return;

    pressures_->node_program.set("element_count", node_count_);
    pressures_->node_program.dispatch(node_count_);
    gl::barrier(gl::Barrier::texture_fetch);

    pressures_->tet_program.set("element_count", tet_count_);
    pressures_->tet_program.dispatch(tet_count_);
    gl::barrier(gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
