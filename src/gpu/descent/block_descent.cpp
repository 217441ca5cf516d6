#include "gpu/descent/block_descent.h"

#include <algorithm>

#include "gpu/chunks.h"
#include "gpu/descent/descent_tables.h"
#include "model/elasticity/node_tets.h"
#include "model/elasticity/tet_strips.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

gl::Defines start_defines(const Model& model) {
    gl::Defines defines = ModelBuffers::collider_defines(model);
    if (!model.loads.empty()) defines.emplace_back("LOADED");
    return defines;
}

gl::Defines volume_defines(const Model& model) {
    if (model.volume_term.is_empty()) return {};
    return {"VOLUME"};
}

gl::Defines sweep_defines(const Model& model) {
    gl::Defines defines = ModelBuffers::collider_defines(model);
    if (model.has_damping()) defines.emplace_back("DAMPED");
    if (!model.neo_hookean_tets.empty()) defines.emplace_back("NEO_HOOKEAN");
    for (const std::string& define : volume_defines(model)) defines.push_back(define);
    return defines;
}

gl::Defines with(gl::Defines defines, const char* another) {
    defines.emplace_back(another);
    return defines;
}

}  // namespace

BlockDescent::DampedSprings::DampedSprings(std::size_t pairs)
    : program(gl::Program::compute("sim/descent/damp_springs.comp")),
      springs(pairs),
      texels(springs, gl::TexelFormat::rgba32f) {
    program.bind("DampedSprings", springs);
}

BlockDescent::Pressures::Pressures(const Model& model, std::span<const std::uint32_t> rows)
    : node_program(gl::Program::compute("sim/descent/find_pressures.comp", {"NODES"})),
      tet_program(gl::Program::compute("sim/descent/find_pressures.comp")),
      node_volumes(model.volume_term.nodes, gl::TexelFormat::rg32f),
      ratios(model.tets.size()),
      node_pressures(model.positions.size()),
      offsets(model.tets.size()) {
    const NodeTets tets = make_node_tets(model.node_count(), model.tets);
    const StripSlices<VolumeStep> packed = pack_volume_strips({model, tets}, rows_of_springs(model, rows));
    strips = {packed.steps, gl::TexelFormat::rgba32ui};
    strip_starts = {packed.slice_starts, gl::TexelFormat::r32ui};
    node_tet_starts = {tets.starts, gl::TexelFormat::r32ui};
    node_tets = {tets.entries, gl::TexelFormat::r32ui};
    offset_texels = {offsets, gl::TexelFormat::r32f};
}

BlockDescent::BlockDescent(const Model& model, const DescentSettings& settings)
    : start_program_(gl::Program::compute("sim/descent/start_descent.comp", start_defines(model))),
      find_tangled_program_(gl::Program::compute("sim/descent/take_back_tangled.comp", {"TETS"})),
      take_back_program_(gl::Program::compute("sim/descent/take_back_tangled.comp")),
      mark_program_(gl::Program::compute("sim/descent/mark_flat_tets.comp", volume_defines(model))),
      sweep_program_(gl::Program::compute("sim/descent/descend.comp", sweep_defines(model))),
      sum_program_(
          gl::Program::compute("sim/descent/sum_rigid_motions.comp", ModelBuffers::collider_defines(model))),
      motion_program_(gl::Program::compute("sim/descent/sum_rigid_motions.comp",
                                           with(ModelBuffers::collider_defines(model), "OBJECTS"))),
      move_program_(gl::Program::compute("sim/descent/move_bodies.comp")),
      last_move_program_(gl::Program::compute("sim/descent/move_bodies.comp",
                                              with(ModelBuffers::collider_defines(model), "LAST"))),
      settings_(settings),
      node_count_(model.node_count()),
      tet_count_(static_cast<std::uint32_t>(model.tets.size())),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      near_flat_(model.positions.size()),
      object_contacts_(model.objects.size()),
      is_tangled_(model.objects.size()),
      motions_(model.objects.size()) {
    const DescentRows rows = make_descent_rows(model);
    if (!model.volume_term.is_empty()) pressures_.emplace(model, rows.nodes);
    colors_ = rows.batches.front().colors;
    const std::vector<std::uint32_t> objects = objects_of_nodes(model);
    neo_hookean_ = NeoHookeanBuffers(model, rows.nodes);
    const TetCorners corners = corners_of(model, rows.nodes);
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);

    row_count_ = static_cast<std::uint32_t>(rows.nodes.size());
    rows_ = {rows_of(rows, objects), gl::TexelFormat::rgba32ui};
    spring_ends_ = {ends_of(rows.springs), gl::TexelFormat::rg32ui};
    springs_ = {springs_of(rows.springs), gl::TexelFormat::rgba32f};
    if (model.has_damping()) damped_springs_.emplace(rows.springs.pairs.size());
    spring_starts_ = {rows.springs.slice_starts, gl::TexelFormat::r32ui};
    tet_corners_ = {corners.corners, gl::TexelFormat::rgba32ui};
    corner_starts_ = {corners.slice_starts, gl::TexelFormat::r32ui};
    tets_ = {model.tets, gl::TexelFormat::rgba32ui};
    tet_rests_ = {rests_of(model), gl::TexelFormat::rgba32f};
    chunks_ = gl::Buffer<Chunk>(chunks);
    chunk_starts_ = {chunk_starts(chunks, model.objects.size()), gl::TexelFormat::r32ui};
    node_objects_ = {objects, gl::TexelFormat::r32ui};
    starts_ = gl::Buffer<glm::vec4>(model.positions.size());
    start_texels_ = {starts_, gl::TexelFormat::rgba32f};
    targets_ = gl::Buffer<glm::vec4>(model.positions.size());
    target_texels_ = {targets_, gl::TexelFormat::rgba32f};
    near_flat_texels_ = {near_flat_, gl::TexelFormat::r32ui};
    rigid_sums_ = gl::Buffer<glm::dvec4>(rigid_sums::kRigidSums * chunks.size());
    if (!model.colliders.empty()) contacts_ = gl::Buffer<ColliderContact>(model.positions.size());

    if (settings_.coarse_level) make_coarse_level(model);
    bind_buffers();
}

void BlockDescent::make_coarse_level(const Model& model) {
    const CoarseBasis basis = make_coarse_basis(model);
    if (basis.cluster_count() == 0) return;
    coarse_.emplace(model, basis);
    force_program_ = gl::Program::compute("sim/descent/descend.comp", with(sweep_defines(model), "FORCES"));
}

std::vector<const gl::Program*> BlockDescent::sweep_programs() const {
    std::vector<const gl::Program*> programs = {&sweep_program_};
    if (coarse_) programs.push_back(&force_program_);
    return programs;
}

// What never changes.
void BlockDescent::bind_buffers() const {
    start_program_.bind("NearFlat", near_flat_);
    start_program_.bind("ObjectContacts", object_contacts_);
    start_program_.bind("Tangled", is_tangled_);
    start_program_.bind("Starts", starts_);
    start_program_.bind("Targets", targets_);
    start_program_.bind("Contacts", contacts_);
    find_tangled_program_.bind("tets", tets_);
    find_tangled_program_.bind("tet_rests", tet_rests_);
    take_back_program_.bind("start_positions", start_texels_);
    for (const gl::Program* program : {&find_tangled_program_, &take_back_program_}) {
        program->bind("node_objects", node_objects_);
        program->bind("Tangled", is_tangled_);
    }
    mark_program_.bind("tets", tets_);
    mark_program_.bind("tet_rests", tet_rests_);
    mark_program_.bind("NearFlat", near_flat_);
    if (pressures_) bind_pressures(*pressures_);
    if (damped_springs_) bind_springs(damped_springs_->program);
    for (const gl::Program* program : sweep_programs()) {
        bind_springs(*program);
        if (damped_springs_) program->bind("springs", damped_springs_->texels);
        program->bind("targets", target_texels_);
        program->bind("near_flat", near_flat_texels_);
        program->bind("tet_corners", tet_corners_);
        program->bind("corner_starts", corner_starts_);
        program->bind("tet_rests", tet_rests_);
        program->bind("ObjectContacts", object_contacts_);
        program->bind("Contacts", contacts_);
        neo_hookean_.bind(*program);
    }
    for (const gl::Program* program : {&sum_program_, &motion_program_}) {
        program->bind("chunk_starts", chunk_starts_);
        program->bind("ObjectContacts", object_contacts_);
        program->bind("Sums", rigid_sums_);
        program->bind("Contacts", contacts_);
    }
    for (const gl::Program* program :
         {&sum_program_, &motion_program_, &move_program_, &last_move_program_}) {
        program->bind("start_positions", start_texels_);
        program->bind("targets", target_texels_);
        program->bind("Chunks", chunks_);
        program->bind("Motions", motions_);
    }
    last_move_program_.bind("ObjectContacts", object_contacts_);
}

void BlockDescent::bind_springs(const gl::Program& program) const {
    program.bind("rows", rows_);
    program.bind("spring_ends", spring_ends_);
    program.bind("springs", springs_);
    program.bind("slice_starts", spring_starts_);
    program.bind("start_positions", start_texels_);
}

void BlockDescent::bind_pressures(const Pressures& pressures) const {
    mark_program_.bind("Ratios", pressures.ratios);
    for (const gl::Program* program : {&pressures.node_program, &pressures.tet_program}) {
        program->bind("tets", tets_);
        program->bind("tet_rests", tet_rests_);
        program->bind("Ratios", pressures.ratios);
        program->bind("Pressures", pressures.node_pressures);
    }
    pressures.node_program.bind("node_volumes", pressures.node_volumes);
    pressures.node_program.bind("node_tet_starts", pressures.node_tet_starts);
    pressures.node_program.bind("node_tets", pressures.node_tets);
    pressures.tet_program.bind("Offsets", pressures.offsets);
    for (const gl::Program* program : sweep_programs()) {
        program->bind("offsets", pressures.offset_texels);
        program->bind("volume_strips", pressures.strips);
        program->bind("volume_starts", pressures.strip_starts);
    }
}

// The nodes' two buffers swap places from step to step.
void BlockDescent::bind_nodes(const NodeBuffers& previous, const NodeBuffers& current) const {
    start_program_.bind("start_positions", previous.position_texels);
    start_program_.bind("start_velocities", previous.velocity_texels);
    start_program_.bind("Positions", current.positions);
    start_program_.bind("EarlierVelocities", current.velocities);
    take_back_program_.bind("Positions", current.positions);
    find_tangled_program_.bind("positions", current.position_texels);
    mark_program_.bind("positions", current.position_texels);
    if (damped_springs_) damped_springs_->program.bind("start_velocities", previous.velocity_texels);
    std::vector<const gl::Program*> programs = sweep_programs();
    programs.insert(programs.end(), {&move_program_, &last_move_program_});
    for (const gl::Program* program : programs) program->bind("OutPositions", current.positions);
    programs.insert(programs.end(), {&sum_program_, &motion_program_});
    for (const gl::Program* program : programs) {
        program->bind("positions", current.position_texels);
        program->bind("start_velocities", previous.velocity_texels);
    }
    for (const gl::Program* program : {&move_program_, &last_move_program_})
        program->bind("Velocities", current.velocities);
}

void BlockDescent::run(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
                       const NodeBuffers& current, double step, bool has_earlier, StageTimer* timer) {
    std::optional<TimedStage> start(std::in_place, timer, "advance_nodes.start");
    for (const gl::Program* program :
         {&start_program_, &sweep_program_, &sum_program_, &move_program_, &last_move_program_}) {
        program->set("time_step", static_cast<float>(step));
    }
    start_program_.set("gravity", model.gravity);
    last_move_program_.set("contact_distance", static_cast<float>(kContactDistance));
    last_move_program_.set("resting_speed", static_cast<float>(resting_speed(model.gravity, step)));
    bind_nodes(previous, current);
    for (const gl::Program* program : sweep_programs()) model.bind_colliders(*program);
    model.bind_colliders(last_move_program_);
    model.bind_colliders(start_program_);
    model.pulls.bind(start_program_);
    if (loads != nullptr) loads->bind(start_program_);
    start_program_.set("node_count", node_count_);
    start_program_.set("object_count", object_count_);
    start_program_.set("has_earlier", has_earlier ? 1u : 0u);
    start_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);

    if (damped_springs_) damp_springs(step);
    take_back_tangled();
    if (coarse_) coarse_->begin(current, step);
    start.reset();

    const auto run_part = [&](const char* name, const auto& work) {
        const TimedStage part(timer, name);
        work();
    };
    std::uint32_t marks = 0;
    for (int i = 0; i < settings_.iterations; ++i) {
        if (i % kSweepsAMotion == 0) run_part("advance_nodes.update_tets", [&] { mark_flat_tets(++marks); });
        run_part("advance_nodes.descend", [&] { sweep(); });
        const bool is_last = i + 1 == settings_.iterations;
        if (coarse_ && !is_last && i % kSweepsACorrection == 0)
            run_part("advance_nodes.correct", [&] { correct(current, step); });
        if (is_last || (i + 1) % kSweepsAMotion == 0)
            run_part("advance_nodes.move_bodies", [&] { move_bodies(is_last); });
    }
}

void BlockDescent::damp_springs(double step) const {
    damped_springs_->program.set("time_step", static_cast<float>(step));
    damped_springs_->program.set("row_count", row_count_);
    damped_springs_->program.dispatch(row_count_);
}

void BlockDescent::take_back_tangled() const {
    find_tangled_program_.set("element_count", tet_count_);
    find_tangled_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage);

    take_back_program_.set("element_count", node_count_);
    take_back_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

// Earlier marks count no more.
void BlockDescent::mark_flat_tets(std::uint32_t mark) const {
    sweep_program_.set("mark", mark);
    if (coarse_) force_program_.set("mark", mark);
    mark_program_.set("mark", mark);
    mark_program_.set("tet_count", tet_count_);
    mark_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
    if (!pressures_) return;

    pressures_->node_program.set("element_count", node_count_);
    pressures_->node_program.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage);

    pressures_->tet_program.set("element_count", tet_count_);
    pressures_->tet_program.dispatch(tet_count_);
    gl::barrier(gl::Barrier::texture_fetch);
}

void BlockDescent::sweep() const {
    descend(sweep_program_, colors_);
}

// One dispatch after another for each of `rows`.
void BlockDescent::descend(const gl::Program& program, std::span<const Range> rows) const {
    for (const Range& range : rows) {
        program.set("first_row", range.first);
        program.set("row_count", range.count);
        program.dispatch(range.count);
        gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
    }
}

// All nodes at once along the motions of clusters, as far as the objective falls.
void BlockDescent::correct(const NodeBuffers& current, double step) {
    const Range all{0, row_count_};
    coarse_->bind_forces(force_program_, false);
    force_program_.set("time_step", static_cast<float>(step));
    force_program_.set("is_ahead", 0u);
    descend(force_program_, {&all, 1});
    coarse_->find_displacements();

    coarse_->bind_forces(force_program_, true);
    force_program_.bind("positions", coarse_->ahead_texels());
    force_program_.set("is_ahead", 1u);
    descend(force_program_, {&all, 1});
    force_program_.bind("positions", current.position_texels);
    coarse_->apply_displacements(chunks_, chunk_starts_);
}

void BlockDescent::move_bodies(bool is_last) const {
    const auto chunks = static_cast<std::uint32_t>(chunks_.size());
    sum_program_.set("element_count", chunks);
    sum_program_.dispatch(rigid_sums::kLanesAChunk * chunks_.size());
    gl::barrier(gl::Barrier::storage);

    motion_program_.set("element_count", object_count_);
    motion_program_.set("is_last", is_last ? 1u : 0u);
    motion_program_.dispatch(object_count_);
    gl::barrier(gl::Barrier::storage);

    const gl::Program& move = is_last ? last_move_program_ : move_program_;
    move.set("element_count", chunks);
    move.dispatch_groups(chunks_.size());
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
