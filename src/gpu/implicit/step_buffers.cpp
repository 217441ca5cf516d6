#include "gpu/implicit/step_buffers.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "gpu/chunks.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

constexpr std::size_t kVectors = 7, kMatrixSums = 18, kPairSums = 21;  // as in shaders

std::vector<float> weights_of(const Model& model) {
    std::vector<float> weights;
    const double gravity = glm::length(glm::dvec3(model.gravity));
    for (const ModelObject& object : model.objects)
        weights.push_back(static_cast<float>(gravity * object.mass));
    return weights;
}

}  // namespace

StepBuffers::StepBuffers(const Model& model, const RowCapacity& capacity, std::uint32_t small_chunks)
    : object_count(static_cast<std::uint32_t>(model.objects.size())),
      has_rows_(capacity.rows > 0),
      small_chunks_(small_chunks),
      weights_(weights_of(model), gl::TexelFormat::r32f) {
    const auto rgba32f = gl::TexelFormat::rgba32f, rgba32ui = gl::TexelFormat::rgba32ui;
    const auto r32f = gl::TexelFormat::r32f, r32ui = gl::TexelFormat::r32ui;
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);
    const std::size_t nodes = model.positions.size(), objects = object_count;
    chunk_count = static_cast<std::uint32_t>(chunks.size());
    sizes_ = {object_count, model.node_count(), chunk_starts(chunks, objects)};
    chunks_ = {chunks, rgba32ui};
    chunk_starts_ = {sizes_.chunk_starts, r32ui};
    for (StepBuffer<glm::vec4>* field :
         {&loads, &displacements, &steps, &residuals, &preconditioned, &products, &bases})
        *field = {nodes, rgba32f};
    blocks_ = {nodes, rgba32f};
    enough = {objects, r32f};
    vectors = {kVectors * (objects + 1), rgba32f};
    body_motions = {objects, rgba32f};
    body_forces_ = {2 * objects, rgba32f};
    bodies_ = {objects, rgba32f};
    inverses_ = {objects, rgba32f};
    states = {2 * objects, rgba32ui};
    parts_ = {objects, r32f};
    islands_ = {objects, rgba32ui};
    for (StepBuffer<std::uint32_t>* table : {&island_of_object_, &island_bodies_}) *table = {objects, r32ui};
    coupling_starts_ = {objects + 1, r32ui};
    body_sums_ = {chunks.size(), rgba32f};
    for (StepBuffer<ResidualSums>* sums : {&base_sums, &sums_, &product_sums_})
        *sums = {chunks.size(), rgba32f};
    lacks_ = {chunks.size(), r32f};
    step_sums_ = {chunks.size(), gl::TexelFormat::rg32f};
    island_chunks_ = {chunks.size(), r32ui};
    entry_starts_ = {nodes + 1, r32ui};  // without rows, too: who gathers them finds none
    grow(capacity);
}

void StepBuffers::grow(const RowCapacity& capacity) {
    const auto rgba32f = gl::TexelFormat::rgba32f, rgba32ui = gl::TexelFormat::rgba32ui;
    const auto r32ui = gl::TexelFormat::r32ui;
    const std::size_t most_rows = capacity.rows,
                      most_chunks = most_rows / contact_tuning::kRowsOfChunk + capacity.pairs;
    rows = {most_rows, rgba32ui};
    row_entries_ = {4 * most_rows, r32ui};
    couplings_ = {2 * capacity.pairs, r32ui};
    pairs_ = {capacity.pairs, rgba32ui};
    row_chunks_ = {most_chunks, gl::TexelFormat::rg32ui};
    tangents_ = {most_rows, rgba32f};
    slips = {most_rows, rgba32f};
    arms_ = {2 * most_rows, rgba32f};
    row_sums_ = {kMatrixSums * most_chunks, rgba32f};
    pair_sums_ = {kPairSums * capacity.pairs, rgba32f};
}

RowTables StepBuffers::tables() const {
    gl::barrier(gl::Barrier::buffer_update);
    const auto read = [](const auto& buffer, auto& values) {
        values.resize(buffer.values.size());
        buffer.values.download(values);
    };
    RowTables tables;
    read(rows, tables.rows);
    read(islands_, tables.islands);
    read(island_of_object_, tables.island_of_object);
    read(island_bodies_, tables.island_bodies);
    read(island_chunks_, tables.island_chunks);
    read(pairs_, tables.pairs);
    read(row_chunks_, tables.row_chunks);
    read(coupling_starts_, tables.coupling_starts);
    read(couplings_, tables.couplings);
    read(entry_starts_, tables.entry_starts);
    read(row_entries_, tables.row_entries);
    return tables;
}

void StepBuffers::unite_islands() {
    has_large_islands_ = chunk_count > small_chunks_;
}

void StepBuffers::set_rows(std::span<const StepRow> new_rows,
                           std::span<const std::uint32_t> islands_of_bodies) {
    const RowTables tables = make_row_tables(sizes_, new_rows, islands_of_bodies);
    has_large_islands_ = std::any_of(
        tables.islands.begin(), tables.islands.end(),
        [&](const StepIsland& island) { return island.chunk_end - island.first_chunk > small_chunks_; });
    islands_.values.upload(tables.islands);
    island_of_object_.values.upload(tables.island_of_object);
    island_bodies_.values.upload(tables.island_bodies);
    island_chunks_.values.upload(tables.island_chunks);
    parts_.values.upload(std::vector<float>(object_count, 1.0f));
    if (!has_rows_) return;
    coupling_starts_.values.upload(tables.coupling_starts);
    couplings_.values.upload(tables.couplings);
    entry_starts_.values.upload(tables.entry_starts);
    row_entries_.values.upload(tables.row_entries);
    pairs_.values.upload(tables.pairs);
    row_chunks_.values.upload(tables.row_chunks);
    rows.values.upload(tables.rows);
}

void StepBuffers::bind(const gl::Program& program) const {
    program.set("chunk_count", chunk_count);
    program.set("object_count", object_count);
    program.set("small_chunks", small_chunks_);
    program.bind_declared("chunks", chunks_);
    program.bind_declared("chunk_starts", chunk_starts_);
    loads.bind(program, "Loads", "loads");
    displacements.bind(program, "Displacements", "displacements");
    steps.bind(program, "Steps", "steps");
    residuals.bind(program, "Residuals", "residuals");
    preconditioned.bind(program, "Preconditioned", "preconditioned");
    products.bind(program, "Products", "products");
    bases.bind(program, "Bases", "bases");
    blocks_.bind(program, "Blocks", "blocks");
    program.bind_declared("Sums", sums_.values);
    program.bind_declared("ProductSums", product_sums_.values);
    program.bind_declared("StepSums", step_sums_.values);
    program.bind_declared("Lacks", lacks_.values);
    bind_bodies(program);
    bind_rows(program);
}

void StepBuffers::bind_bodies(const gl::Program& program) const {
    enough.bind(program, "Enough", "enough");
    program.bind_declared("weights", weights_);
    program.bind_declared("BodySums", body_sums_.values);
    bodies_.bind(program, "Bodies", "bodies");
    inverses_.bind(program, "Inverses", "inverses");
    vectors.bind(program, "Vectors", "motions");  // motions are the first of them
    body_motions.bind(program, "BodyMotions", "body_motions");
    program.bind_declared("BodyForces", body_forces_.values);
    base_sums.bind(program, "BaseSums", "base_sums");
    states.bind(program, "States", "states");
    parts_.bind(program, "Parts", "parts");
    islands_.bind(program, "Islands", "islands");
    island_of_object_.bind(program, "IslandOfObject", "island_of_object");
    island_bodies_.bind(program, "IslandBodies", "island_bodies");
    island_chunks_.bind(program, "IslandChunks", "island_chunks");
}

void StepBuffers::bind_rows(const gl::Program& program) const {
    program.bind_declared("Rows", rows.values);
    slips.bind(program, "Slips", "slips");
    arms_.bind(program, "Arms", "arms");
    program.bind_declared("RowSums", row_sums_.values);
    program.bind_declared("PairSums", pair_sums_.values);
    tangents_.bind(program, "Tangents", "tangents");
    pairs_.bind(program, "Pairs", "pairs");
    row_chunks_.bind(program, "RowChunks", "row_chunks");
    coupling_starts_.bind(program, "CouplingStarts", "coupling_starts");
    couplings_.bind(program, "Couplings", "couplings");
    entry_starts_.bind(program, "EntryStarts", "entry_starts");
    row_entries_.bind(program, "RowEntries", "row_entries");
}

}  // namespace gelatin::gpu
