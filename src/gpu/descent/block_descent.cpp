#include "gpu/descent/block_descent.h"

#include <algorithm>

#include "gpu/chunks.h"
#include "model/descent/descent_rows.h"
#include "model/elasticity/neo_hookean.h"
#include "model/elasticity/node_tets.h"

namespace gelatin::gpu {
namespace {

constexpr std::size_t kRigidSums = 16;    // dvec4s in RigidSums, sim/descent/rigid_sums.glsl
constexpr std::size_t kLanesAChunk = 16;  // sim/descent/sum_rigid_motions.comp

gl::Defines start_defines(const Model& model, bool pulled) {
    gl::Defines defines = ModelBuffers::collider_defines(model);
    if (!model.loads.empty()) defines.emplace_back("LOADED");
    if (pulled) defines.emplace_back("PULLED");
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

std::vector<glm::vec4> rests_of(const Model& model) {
    const std::vector<float>& stiffnesses = model.volume_term.tets;
    std::vector<glm::vec4> rests;
    for (std::size_t t = 0; t < model.tet_rests.size(); ++t) {
        const TetRest& rest = model.tet_rests[t];
        rests.emplace_back(rest.volume, rest.modulus, stiffnesses.empty() ? 0.0f : stiffnesses[t], 0.0f);
    }
    return rests;
}

std::vector<glm::uvec2> ends_of(const HalfSprings& springs) {
    std::vector<glm::uvec2> ends;
    for (const HalfSpringPair& pair : springs.pairs) ends.emplace_back(pair.node_0, pair.node_1);
    return ends;
}

std::vector<glm::vec4> springs_of(const HalfSprings& springs) {
    std::vector<glm::vec4> result;
    for (std::size_t p = 0; p < springs.pairs.size(); ++p) {
        const HalfSpringPair& pair = springs.pairs[p];
        const glm::vec2& stiffness = springs.stiffness[p];
        result.emplace_back(pair.rest_length_0, stiffness.x, pair.rest_length_1, stiffness.y);
    }
    return result;
}

// Pairs of half springs that the row's slice has for it.
std::uint32_t pair_count(const HalfSprings& springs, std::uint32_t row) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const std::uint32_t slice = row / kSlice, first = springs.slice_starts[slice] + row % kSlice;
    std::uint32_t count = (springs.slice_starts[slice + 1] - springs.slice_starts[slice]) / kSlice;
    while (count > 0 && springs.stiffness[first + (count - 1) * kSlice] == glm::vec2(0.0f)) --count;
    return count;
}

std::vector<DescentRow> rows_of(const Model& model, const DescentRows& rows,
                                const std::vector<std::uint32_t>& objects) {
    std::vector<DescentRow> result;
    for (std::uint32_t r = 0; r < rows.nodes.size(); ++r) {
        const std::uint32_t n = rows.nodes[r], o = n == kNoNode ? 0 : objects[n];
        const ModelObject& object = model.objects[o];
        result.push_back(
            {n, o, pair_count(rows.springs, r), object.tets.first - object.neo_hookean_tets.first});
    }
    return result;
}

// Without the nodes of neo-Hookean tets, which have their terms with those.
TetCorners corners_of(const Model& model, std::vector<std::uint32_t> rows) {
    for (std::uint32_t& node : rows) {
        if (node != kNoNode && has_neo_hookean_tets(model, node)) node = kNoNode;
    }
    return pack_tet_corners(rows, make_node_tets(model.node_count(), model.tets), model.tets);
}

}  // namespace

BlockDescent::DampedSprings::DampedSprings(std::size_t pairs)
    : program(gl::Program::compute("sim/descent/damp_springs.comp")),
      springs(pairs),
      texels(springs, gl::TexelFormat::rgba32f) {}

BlockDescent::Pressures::Pressures(const Model& model)
    : node_program(gl::Program::compute("sim/descent/find_pressures.comp", {"NODES"})),
      tet_program(gl::Program::compute("sim/descent/find_pressures.comp")),
      node_volumes(model.volume_term.nodes, gl::TexelFormat::rg32f),
      ratios(model.tets.size()),
      node_pressures(model.positions.size()),
      offsets(model.tets.size()) {
    const NodeTets tets = make_node_tets(model.node_count(), model.tets);
    node_tet_starts = {tets.starts, gl::TexelFormat::r32ui};
    node_tets = {tets.entries, gl::TexelFormat::r32ui};
    offset_texels = {offsets, gl::TexelFormat::r32f};
}

BlockDescent::BlockDescent(const Model& model, const DescentSettings& settings, bool pulled)
    : start_program_(gl::Program::compute("sim/descent/start_descent.comp", start_defines(model, pulled))),
      find_tangled_program_(gl::Program::compute("sim/descent/take_back_tangled.comp", {"TETS"})),
      take_back_program_(gl::Program::compute("sim/descent/take_back_tangled.comp")),
      accelerate_program_(gl::Program::compute("sim/descent/accelerate_descent.comp")),
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
      object_touches_(model.objects.size()),
      is_tangled_(model.objects.size()),
      motions_(model.objects.size()) {
    if (!model.volume_term.is_empty()) pressures_.emplace(model);
    if (settings_.chebyshev > 0.0) sweep_starts_ = gl::Buffer<glm::vec4>(2 * model.positions.size());
    const DescentRows rows = make_descent_rows(model);
    colors_ = rows.batches.front().colors;
    const std::vector<std::uint32_t> objects = objects_of_nodes(model);
    neo_hookean_corners_ = NeoHookeanBuffers::Corners(model, rows.nodes);
    const TetCorners corners = corners_of(model, rows.nodes);
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);

    row_count_ = static_cast<std::uint32_t>(rows.nodes.size());
    rows_ = {rows_of(model, rows, objects), gl::TexelFormat::rgba32ui};
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
    rigid_sums_ = gl::Buffer<glm::dvec4>(kRigidSums * chunks.size());
    if (!model.colliders.empty()) touches_ = gl::Buffer<Touch>(model.positions.size());

    if (!settings_.coarse_level) return;
    const CoarseBasis basis = make_coarse_basis(model);
    if (basis.cluster_count() == 0) return;
    coarse_.emplace(model, basis);
    force_program_ = gl::Program::compute("sim/descent/descend.comp", with(sweep_defines(model), "FORCES"));
}

void BlockDescent::run(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
                       double step, bool has_earlier) {
    for (const gl::Program* program :
         {&start_program_, &sweep_program_, &sum_program_, &move_program_, &last_move_program_}) {
        program->set("time_step", static_cast<float>(step));
        program->set("gravity", model.gravity);
    }
    last_move_program_.set("contact_distance", static_cast<float>(kContactDistance));
    last_move_program_.set("resting_speed", static_cast<float>(resting_speed(model.gravity, step)));
    previous.position_texels.bind(1);
    previous.velocity_texels.bind(2);
    current.positions.bind_storage(0);
    near_flat_.bind_storage(1);
    object_touches_.bind_storage(2);
    current.velocities.bind_storage(3);
    is_tangled_.bind_storage(4);
    starts_.bind_storage(5);
    targets_.bind_storage(6);
    if (touches_.size() > 0) touches_.bind_storage(7);
    model.bind_colliders(start_program_);
    if (model.pulls) model.pulls->bind(start_program_);
    start_program_.set("node_count", node_count_);
    start_program_.set("object_count", object_count_);
    start_program_.set("has_earlier", has_earlier ? 1u : 0u);
    start_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);

    current.position_texels.bind(0);
    start_texels_.bind(1);
    target_texels_.bind(17);
    near_flat_texels_.bind(18);
    rows_.bind(3);
    spring_starts_.bind(6);
    if (damped_springs_) damp_springs(step);
    take_back_tangled(current);
    if (coarse_) coarse_->begin(step);
    std::uint32_t looks = 0;
    for (int i = 0; i < settings_.iterations; ++i) {
        if (settings_.chebyshev > 0.0) accelerate(coarse_ ? sweeps_since_correction(i) : i);
        if (i % kSweepsAMotion == 0) look_at_tets(++looks);
        sweep(model);
        const bool is_last = i + 1 == settings_.iterations;
        if (coarse_ && !is_last && i % kSweepsACorrection == 0) correct(model, current, step);
        if (is_last || (i + 1) % kSweepsAMotion == 0) move_bodies(model, current, is_last);
    }
}

void BlockDescent::damp_springs(double step) const {
    spring_ends_.bind(4);
    springs_.bind(5);
    damped_springs_->springs.bind_storage(0);
    damped_springs_->program.set("time_step", static_cast<float>(step));
    damped_springs_->program.set("row_count", row_count_);
    damped_springs_->program.dispatch(row_count_);
}

void BlockDescent::take_back_tangled(const NodeBuffers& current) const {
    tets_.bind(9);
    tet_rests_.bind(10);
    node_objects_.bind(12);
    is_tangled_.bind_storage(4);
    find_tangled_program_.set("element_count", tet_count_);
    find_tangled_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage);

    current.positions.bind_storage(0);
    take_back_program_.set("element_count", node_count_);
    take_back_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

void BlockDescent::accelerate(int sweep) const {
    sweep_starts_.bind_storage(3);
    object_touches_.bind_storage(2);
    node_objects_.bind(12);
    accelerate_program_.set("node_count", node_count_);
    accelerate_program_.set("sweep", static_cast<std::uint32_t>(sweep));
    accelerate_program_.set("weight", static_cast<float>(chebyshev_weight(settings_.chebyshev, sweep)));
    accelerate_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

// Marks of earlier looks count no more.
void BlockDescent::look_at_tets(std::uint32_t look) const {
    sweep_program_.set("look", look);
    if (coarse_) force_program_.set("look", look);
    mark_program_.set("look", look);
    tets_.bind(9);
    tet_rests_.bind(10);
    near_flat_.bind_storage(1);
    if (pressures_) pressures_->ratios.bind_storage(3);
    mark_program_.set("tet_count", tet_count_);
    mark_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
    if (!pressures_) return;

    pressures_->node_volumes.bind(11);
    pressures_->node_tet_starts.bind(12);
    pressures_->node_tets.bind(13);
    pressures_->node_pressures.bind_storage(4);
    pressures_->node_program.set("element_count", node_count_);
    pressures_->node_program.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage);

    pressures_->offsets.bind_storage(5);
    pressures_->tet_program.set("element_count", tet_count_);
    pressures_->tet_program.dispatch(tet_count_);
    gl::barrier(gl::Barrier::texture_fetch);
}

void BlockDescent::sweep(const ModelBuffers& model) const {
    descend(sweep_program_, model, colors_);
}

// One dispatch after another for each of `rows`.
void BlockDescent::descend(const gl::Program& program, const ModelBuffers& model,
                           std::span<const Range> rows) const {
    rows_.bind(3);
    spring_ends_.bind(4);
    if (damped_springs_) {
        damped_springs_->texels.bind(5);
    } else {
        springs_.bind(5);
    }
    spring_starts_.bind(6);
    model.bind_colliders(program);
    tet_corners_.bind(8);
    corner_starts_.bind(9);
    tet_rests_.bind(10);
    if (pressures_) pressures_->offset_texels.bind(11);
    model.neo_hookean.bind_tets();
    neo_hookean_corners_.bind();
    if (touches_.size() > 0) touches_.bind_storage(3);
    for (const Range& range : rows) {
        program.set("first_row", range.first);
        program.set("row_count", range.count);
        program.dispatch(range.count);
        gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
    }
}

// All nodes at once along the motions of clusters, as far as the objective falls.
void BlockDescent::correct(const ModelBuffers& model, const NodeBuffers& current, double step) {
    const Range all{0, row_count_};
    coarse_->bind_forces(false);
    force_program_.set("time_step", static_cast<float>(step));
    force_program_.set("is_ahead", 0u);
    descend(force_program_, model, {&all, 1});
    coarse_->find_ways();

    coarse_->bind_forces(true);
    coarse_->ahead_texels().bind(0);
    force_program_.set("is_ahead", 1u);
    descend(force_program_, model, {&all, 1});
    current.position_texels.bind(0);
    coarse_->follow_ways(chunks_, chunk_starts_);
}

void BlockDescent::move_bodies(const ModelBuffers& model, const NodeBuffers& current, bool is_last) const {
    chunk_starts_.bind(3);
    chunks_.bind_storage(3);
    rigid_sums_.bind_storage(4);
    motions_.bind_storage(5);
    if (touches_.size() > 0) touches_.bind_storage(6);
    const auto chunks = static_cast<std::uint32_t>(chunks_.size());
    sum_program_.set("element_count", chunks);
    sum_program_.dispatch(kLanesAChunk * chunks_.size());
    gl::barrier(gl::Barrier::storage);

    motion_program_.set("element_count", object_count_);
    motion_program_.set("is_last", is_last ? 1u : 0u);
    motion_program_.dispatch(object_count_);
    gl::barrier(gl::Barrier::storage);

    const gl::Program& move = is_last ? last_move_program_ : move_program_;
    if (is_last) {
        current.velocities.bind_storage(1);
        model.bind_colliders(move);
    }
    move.set("element_count", chunks);
    move.dispatch(64 * chunks_.size());
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
