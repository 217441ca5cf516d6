#include "gpu/implicit/pair_rows.h"

#include <algorithm>
#include <cassert>

#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

std::vector<glm::vec2> touches_of(const ContactSurface& surface) {
    std::vector<glm::vec2> touches;
    for (const ContactSurface::Touch& touch : surface.touches)
        touches.emplace_back(touch.friction, touch.stiffness);
    return touches;
}

std::vector<glm::uvec2> across_of(const ContactSurface& surface) {
    std::vector<glm::uvec2> across;
    for (const CornerAcross& corner : surface.across) across.emplace_back(corner.face, corner.corner);
    return across;
}

// Of belts.
std::vector<glm::vec4> surface_velocities_of(const Model& model) {
    std::vector<glm::vec4> velocities(model.objects.size(), glm::vec4(0.0f));
    for (std::size_t s = 0; s < model.surfaces.size(); ++s)
        velocities[model.body_count() + s] = glm::vec4(model.surfaces[s].velocity, 0.0f);
    return velocities;
}

}  // namespace

PairRows::Programs::Programs()
    : weigh(gl::Program::compute("sim/implicit/weigh_pairs.comp")),
      count_slot_rows(gl::Program::compute("sim/implicit/count_slot_rows.comp")),
      label(gl::Program::compute("sim/implicit/label_islands.comp")),
      label_all(gl::Program::compute("sim/implicit/label_islands.comp", {"PAIRS"})),
      order(gl::Program::compute("sim/implicit/order_bodies.comp")),
      place(gl::Program::compute("sim/implicit/place_pairs.comp")),
      place_slot_rows(gl::Program::compute("sim/implicit/place_slot_rows.comp")),
      couple(gl::Program::compute("sim/implicit/couple_bodies.comp")),
      sum_islands(gl::Program::compute("sim/implicit/sum_islands.comp")),
      count_entries(gl::Program::compute("sim/implicit/count_entries.comp")),
      start_entries(gl::Program::compute("sim/implicit/start_entries.comp")),
      make(gl::Program::compute("sim/implicit/make_pair_rows.comp")),
      sort(gl::Program::compute("sim/implicit/sort_entries.comp")),
      note(gl::Program::compute("sim/implicit/note_rows.comp")),
      remember(gl::Program::compute("sim/implicit/remember_rows.comp")) {}

std::vector<const gl::Program*> PairRows::Programs::all() const {
    return {&weigh,   &count_slot_rows, &label,         &label_all,     &order, &place, &place_slot_rows,
            &couple,  &sum_islands,     &count_entries, &start_entries, &make,  &sort,  &note,
            &remember};
}

PairRows::PairRows(const Model& model, const ContactSurface& surface, StepState& state, StepSystem& system,
                   const PairBuffers& pairs)
    : node_count_(model.node_count()),
      body_count_(static_cast<std::uint32_t>(model.body_count())),
      collider_count_(static_cast<std::uint32_t>(model.colliders.size())),
      chunk_count_(system.buffers().chunk_count),
      kind_count_(surface.kind_count),
      state_(state),
      system_(system),
      pairs_(pairs),
      kinds_(surface.kinds, gl::TexelFormat::r32ui),
      node_face_starts_(model.node_faces.starts, gl::TexelFormat::r32ui),
      node_faces_(model.node_faces.faces, gl::TexelFormat::r32ui),
      touches_(touches_of(surface), gl::TexelFormat::rg32f),
      across_(across_of(surface), gl::TexelFormat::rg32ui),
      beside_edges_(surface.beside_edges, gl::TexelFormat::rg32ui),
      rest_positions_(model.positions, gl::TexelFormat::rgba32f),
      surface_velocities_(surface_velocities_of(model), gl::TexelFormat::rgba32f),
      body_touches_(body_count_, gl::TexelFormat::rgba32ui),
      body_places_(body_count_, gl::TexelFormat::rgba32ui),
      body_starts_(body_count_, gl::TexelFormat::rgba32f),
      labels_(model.objects.size(), gl::TexelFormat::r32ui),
      chunk_entries_(chunk_count_, gl::TexelFormat::r32ui),
      entry_counts_(std::vector<std::uint32_t>(node_count_)),
      known_starts_(node_count_ + 1, gl::TexelFormat::r32ui) {
    system.buffers().unite_islands();
    make_room();
    bind_buffers();
}

// For pairs and rows.
void PairRows::make_room() {
    const PairCapacity& pairs = pairs_.capacity;
    const RowCapacity& rows = system_.capacity();
    assert(rows.rows > 0 && rows.pairs >= body_count_ + pairs.slots);
    pair_weights_ = {pairs.pairs, gl::TexelFormat::rgba32ui};
    slot_rows_ = {pairs.slots, gl::TexelFormat::rgba32ui};
    row_places_ = {body_count_ + pairs.slots, gl::TexelFormat::rgba32ui};
    row_notes_ = gl::Buffer<RowMemory>(std::vector<RowMemory>(rows.rows));
    known_entries_ = {4 * rows.rows, gl::TexelFormat::r32ui};
    known_rows_ = {rows.rows, gl::TexelFormat::rgba32ui};
}

void PairRows::grow() {
    const Memory known = memory();
    make_room();
    set_memory(known);
    bind_buffers();
}

void PairRows::bind_buffers() const {
    for (const gl::Program* program : programs_.all()) {
        system_.buffers().bind(*program);
        state_.bind(*program);
        bind(*program);
    }
}

std::vector<const gl::Program*> PairRows::programs() const {
    return programs_.all();
}

void PairRows::bind(const gl::Program& program) const {
    pairs_.bind(program);
    bind_tables(program);
    program.bind_declared("positions", state_.from.position_texels);
    pair_weights_.bind(program, "PairWeights", "pair_weights");
    slot_rows_.bind(program, "RowsOfSlots", "slot_rows");
    row_places_.bind(program, "RowPlaces", "row_places");
    body_touches_.bind(program, "BodyTouches", "body_touches");
    body_places_.bind(program, "BodyPlaces", "body_places");
    program.bind_declared("StartsOfBodies", body_starts_.values);
    labels_.bind(program, "Labels", "labels");
    chunk_entries_.bind(program, "EntriesOfChunks", "chunk_entries");
    program.bind_declared("EntryCounts", entry_counts_);
    program.bind_declared("RowNotes", row_notes_);
    known_starts_.bind(program, "KnownStarts", "known_starts");
    known_entries_.bind(program, "KnownEntries", "known_entries");
    known_rows_.bind(program, "KnownRows", "known_rows");
    program.set("row_capacity", static_cast<std::uint32_t>(system_.capacity().rows));
    program.set("node_count", node_count_);
    program.set("collider_count", collider_count_);
}

void PairRows::bind_tables(const gl::Program& program) const {
    program.bind_declared("kinds", kinds_);
    program.bind_declared("touches", touches_);
    program.bind_declared("node_face_starts", node_face_starts_);
    program.bind_declared("node_faces", node_faces_);
    program.bind_declared("across", across_);
    program.bind_declared("beside_edges", beside_edges_);
    program.bind_declared("rest_positions", rest_positions_);
    program.bind_declared("surface_velocities", surface_velocities_);
    program.set("kind_count", kind_count_);
}

void PairRows::run(const gl::Program& program, std::size_t groups) const {
    state_.tries.run(Tries::Where::makes_part, program, groups);
}

void PairRows::weigh(const ModelBuffers& model) {
    programs_.weigh.bind("faces", model.face_texels);
    gl::barrier(gl::Barrier::buffer_update);
    entry_counts_.fill(0);
    state_.tries.run_counted(programs_.weigh, pair_stages::kNearPairs);
    state_.tries.run_counted(programs_.count_slot_rows, pair_stages::kSlotGroups);
}

void PairRows::place(bool has_forces) const {
    const Programs& p = programs_;
    p.sum_islands.set("has_forces", has_forces ? 1u : 0u);
    run(p.label, 1);
    run(p.order, (body_count_ + 63) / 64);
    run(p.place, 1);
    run(p.place_slot_rows, body_count_);
    run(p.couple, body_count_);
    run(p.sum_islands, body_count_);
    run(p.count_entries, chunk_count_);
    run(p.start_entries, chunk_count_);
    state_.tries.run_counted(p.make, pair_stages::kNearPairs);
}

void PairRows::sort() const {
    run(programs_.sort, (node_count_ + 63) / 64);
}

void PairRows::find_guard_islands(const gl::Buffer<std::uint32_t>& labels) const {
    programs_.label_all.bind("Labels", labels);
    state_.tries.run(Tries::Where::goes_on, programs_.label_all, 1);
}

void PairRows::note() const {
    state_.tries.run_counted(programs_.note, try_dispatches::kRows);
}

void PairRows::remember(const gl::Buffer<BodyChange>& changes) const {
    programs_.remember.bind("BodyChanges", changes);
    state_.tries.run(Tries::Where::goes_on, programs_.remember, (node_count_ + 63) / 64);
}

PairRows::Memory PairRows::memory() const {
    Memory memory{read(known_starts_.values), read(known_entries_.values), read(known_rows_.values)};
    memory.entries.resize(memory.starts.back());
    std::uint32_t rows = 0;
    for (const std::uint32_t entry : memory.entries) rows = std::max(rows, entry / 4 + 1);
    memory.rows.resize(rows);
    return memory;
}

void PairRows::set_memory(const Memory& memory) {
    assert(memory.starts.size() == node_count_ + std::size_t(1));
    known_starts_.values.upload(memory.starts);
    known_entries_.values.upload(memory.entries);
    known_rows_.values.upload(memory.rows);
}

void PairRows::forget() {
    gl::barrier(gl::Barrier::buffer_update);
    known_starts_.values.fill(0);
}

}  // namespace gelatin::gpu
