#include "gpu/support/pair_rows_scenarios.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

#include "cpu/implicit/contact_rows.h"
#include "gpu/chunks.h"
#include "gpu/support/part_start_on_gpu.h"
#include "gpu/support/part_start_reference.h"
#include "gpu/support/start_errors.h"
#include "model/assembly/build_model.h"
#include "support/contact_scenes.h"
#include "support/elastic_cases.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

using Numbers = std::vector<std::uint32_t>;

// What tables say, whatever the order of islands, of pairs in them, and of rows in these. All numbers of rows
// are those in the order of their keys.
struct TableContents {
    std::map<std::uint32_t, std::array<Numbers, 3>> islands;  // by least body: bodies, chunks, rows
    std::map<Numbers, Numbers> pairs;                         // by objects and least row: rows
    std::map<std::uint32_t, std::vector<Numbers>> couplings;  // by object: objects and least row, side
    std::vector<std::vector<Numbers>> entries;                // by node: row, bits of the weight
    bool is_whole = true;                                     // chunks of pairs have all of their rows

    bool operator==(const TableContents&) const = default;
};

class TableReader {
public:
    TableReader(const gpu::RowTables& tables, std::uint32_t objects, std::uint32_t nodes)
        : tables_(tables), objects_(objects), nodes_(nodes) {
        for (const StepIsland& island : tables_.islands) row_count_ = std::max(row_count_, island.row_end);
        number_rows();
    }

    TableContents contents() {
        for (const StepIsland& island : tables_.islands)
            if (island.first_body < island.body_end) add_island(island);
        for (std::uint32_t o = 0; o < objects_; ++o) {
            const std::uint32_t first = tables_.coupling_starts[o], end = tables_.coupling_starts[o + 1];
            for (std::uint32_t c = first; c < end; ++c) {
                Numbers coupling = key_of_pair(tables_.pairs[tables_.couplings[c] / 2]);
                coupling.push_back(tables_.couplings[c] % 2);
                contents_.couplings[o].push_back(coupling);
            }
            std::sort(contents_.couplings[o].begin(), contents_.couplings[o].end());
        }
        for (std::uint32_t n = 0; n < nodes_; ++n) add_entries(n);
        return contents_;
    }

private:
    void number_rows() {
        std::vector<std::pair<Numbers, std::uint32_t>> keys;
        for (std::uint32_t r = 0; r < row_count_; ++r) {
            const StepRow& row = tables_.rows[r];
            Numbers key{row.plane, row.node_0, row.node_1, row.node_2, row.node_3};
            for (int k = 0; k < 4; ++k) key.push_back(bits_of(row.weights[k]));
            keys.emplace_back(key, r);
        }
        std::sort(keys.begin(), keys.end());
        numbers_.resize(row_count_);
        for (std::uint32_t k = 0; k < row_count_; ++k) numbers_[keys[k].second] = k;
    }

    static std::uint32_t bits_of(float value) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof(bits));
        return bits;
    }

    Numbers rows_of(std::uint32_t first, std::uint32_t end) const {
        Numbers rows(numbers_.begin() + first, numbers_.begin() + end);
        std::sort(rows.begin(), rows.end());
        return rows;
    }

    glm::uvec2 range_of(const StepPair& pair) {
        const glm::uvec2 range{tables_.row_chunks[pair.first_chunk].x,
                               tables_.row_chunks[pair.chunk_end - 1].y};
        std::uint32_t next = range.x;
        for (std::uint32_t c = pair.first_chunk; c < pair.chunk_end; ++c) {
            const glm::uvec2 chunk = tables_.row_chunks[c];
            const std::uint32_t count = chunk.y - chunk.x;
            contents_.is_whole =
                contents_.is_whole && chunk.x == next && count > 0 && count <= contact_tuning::kRowsOfChunk;
            next = chunk.y;
        }
        return range;
    }

    Numbers key_of_pair(const StepPair& pair) {
        const glm::uvec2 range = range_of(pair);
        return {pair.object, pair.other, rows_of(range.x, range.y).at(0)};
    }

    void add_island(const StepIsland& island) {
        Numbers bodies(tables_.island_bodies.begin() + island.first_body,
                       tables_.island_bodies.begin() + island.body_end);
        Numbers chunks(tables_.island_chunks.begin() + island.first_chunk,
                       tables_.island_chunks.begin() + island.chunk_end);
        std::sort(bodies.begin(), bodies.end());
        std::sort(chunks.begin(), chunks.end());
        for (const std::uint32_t o : bodies) {
            const std::uint32_t number = tables_.island_of_object[o];
            contents_.is_whole = contents_.is_whole && number < objects_ &&
                                 tables_.islands[number].first_body == island.first_body;
        }
        std::uint32_t next = island.first_row, next_chunk = island.first_row_chunk;
        for (std::uint32_t p = island.first_pair; p < island.pair_end; ++p) {
            const StepPair& pair = tables_.pairs[p];
            const glm::uvec2 range = range_of(pair);
            contents_.is_whole = contents_.is_whole && range.x == next && pair.first_chunk == next_chunk;
            for (std::uint32_t r = range.x; r < range.y; ++r)
                contents_.is_whole = contents_.is_whole && tables_.rows[r].object == pair.object &&
                                     tables_.rows[r].other == pair.other;
            contents_.pairs[key_of_pair(pair)] = rows_of(range.x, range.y);
            next = range.y;
            next_chunk = pair.chunk_end;
        }
        contents_.is_whole =
            contents_.is_whole && next == island.row_end && next_chunk == island.row_chunk_end;
        contents_.islands[bodies.at(0)] = {bodies, chunks, rows_of(island.first_row, island.row_end)};
    }

    void add_entries(std::uint32_t n) {
        std::vector<Numbers>& entries = contents_.entries.emplace_back();
        for (std::uint32_t e = tables_.entry_starts[n]; e < tables_.entry_starts[n + 1]; ++e) {
            const std::uint32_t entry = tables_.row_entries[e];
            const float weight = tables_.rows[entry / 4].weights[static_cast<int>(entry % 4)];
            entries.push_back({numbers_[entry / 4], bits_of(weight)});
            if (e > tables_.entry_starts[n])
                contents_.is_whole = contents_.is_whole && entry > tables_.row_entries[e - 1];
        }
        std::sort(entries.begin(), entries.end());
    }

    const gpu::RowTables& tables_;
    std::uint32_t objects_, nodes_, row_count_ = 0;
    Numbers numbers_;  // of rows
    TableContents contents_;
};

// With the objects that rows have before they are in tables.
std::vector<StepRow> rows_of_objects(const StartOnGpu& gpu, const gpu::RowTables& tables) {
    const std::vector<cpu::ContactRow<double>> contacts = gpu.rows();
    std::vector<StepRow> rows(tables.rows.begin(),
                              tables.rows.begin() + static_cast<std::ptrdiff_t>(contacts.size()));
    for (std::size_t r = 0; r < rows.size(); ++r) {
        rows[r].object = contacts[r].object;
        rows[r].other = contacts[r].other;
    }
    return rows;
}

double table_error(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    StartOnGpu gpu(at, inputs, expected.near);
    gpu.run();
    const Model& model = *at.model;
    const auto objects = static_cast<std::uint32_t>(model.objects.size());
    const gpu::RowTables actual = gpu.system.buffers().tables();
    const gpu::RowTableSizes sizes{objects, model.node_count(),
                                   gpu::chunk_starts(gpu::make_chunks(model, &ModelObject::nodes), objects)};
    const std::vector<StepRow> rows = rows_of_objects(gpu, actual);
    const gpu::RowTables host = gpu::make_row_tables(sizes, rows, expected.islands);
    const TableContents contents = TableReader(actual, objects, model.node_count()).contents();
    return error_if(rows.empty() || !contents.is_whole ||
                    !(contents == TableReader(host, objects, model.node_count()).contents()));
}

// What contacts hold after some displacements, and what the next part knows of it.
double memory_error(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    StartOnGpu gpu(at, inputs, expected.near);
    gpu.run();
    const Model& model = *at.model;
    const gpu::RowTables tables = gpu.system.buffers().tables();
    const std::vector<cpu::ContactRow<double>> rows = gpu.rows();
    std::vector<glm::dvec3> moved;
    for (const cpu::Vec3<double>& d : random_field<double>(model.node_count(), 8)) moved.push_back(3e-4 * d);
    std::vector<glm::vec4> slips;
    for (const cpu::ContactRow<double>& row : rows)
        slips.emplace_back(cpu::relative<double>(row, moved), row.limit);
    gpu.system.buffers().slips.values.upload(slips);
    gpu.pair_rows->note();
    gl::Buffer<BodyChange> changes(std::vector<BodyChange>(model.objects.size()));
    gpu.pair_rows->forget();
    gpu.pair_rows->remember(changes);
    StartErrors errors;
    errors.require(gpu.pair_rows->memory().entries.empty());
    for (std::uint32_t made = 1; made <= 2; ++made) {
        BodyChange change{};
        change.action = 3 - made;
        changes.upload(std::vector<BodyChange>(model.objects.size(), change));
        gpu.pair_rows->remember(changes);
        errors.require(gpu.pair_rows->memory().entries.empty() == (made == 1));
    }
    const gpu::PairRows::Memory memory = gpu.pair_rows->memory();
    errors.require(memory.rows.size() == rows.size() && memory.starts == tables.entry_starts &&
                   std::equal(memory.entries.begin(), memory.entries.end(), tables.row_entries.begin()));
    for (std::size_t r = 0; r < std::min(rows.size(), memory.rows.size()); ++r) {
        cpu::ContactRow<double> row = rows[r];
        const RowMemory& known = memory.rows[r];
        const glm::dvec3 s = cpu::relative<double>(row, moved);
        row.limit = row.friction * row.pressing(s);
        const double force = 1e-6 * row.stiffness + 1e-4 * row.limit;
        errors.add(known.hold.w, row.limit, force);
        errors.add(glm::dvec3(known.hold), row.limit > 0.0 ? row.held(s) : glm::dvec3(0.0), force);
        errors.add(known.reach, row.reach, 1e-9);
        errors.require((known.is_edges == packing::kNone) == (row.object == kNoNode));
        if (row.object != kNoNode && known.is_edges == 0)
            errors.require(known.first == row.nodes[0] && known.second == row.other);
    }
    return errors.worst();
}

// All of it twice.
double repeat_error(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    std::vector<gpu::RowTables> tables;
    for (int k = 0; k < 2; ++k) {
        StartOnGpu gpu(at, inputs, expected.near);
        gpu.run();
        tables.push_back(gpu.system.buffers().tables());
    }
    const auto is_same = [](const auto& a, const auto& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
    };
    const gpu::RowTables &a = tables[0], &b = tables[1];
    return error_if(!is_same(a.rows, b.rows) || !is_same(a.islands, b.islands) ||
                    !is_same(a.pairs, b.pairs) || !is_same(a.row_entries, b.row_entries) ||
                    !is_same(a.couplings, b.couplings));
}

// Without places the try is given up, and rows are not written.
double overflow_error(StartCase at, bool pairs_are_full) {
    const auto [inputs, expected] = part_start_reference(at);
    if (!pairs_are_full) at.capacity = expected.rows.size() - 1;
    StartOnGpu gpu(at, inputs, expected.near);
    const StepRow mark{7, 7, 7, 7, {}, {}, 7.0f, 7.0f, 7.0f, 7.0f, {}, 7, 7, 7, 7.0f};
    gpu.system.buffers().rows.values.upload(std::vector<StepRow>(at.capacity, mark));
    if (pairs_are_full) {
        PairCounts counts{};
        counts.is_full = 1;
        counts.pairs = counts.slots = 1u << 30;
        gpu.start.predict(gpu.buffers, nullptr);
        gpu.pairs->counts.upload(std::vector{counts});
        gpu.start.find_rows(gpu.buffers, nullptr);
        gpu.start.linearise(gpu.buffers, nullptr);
    } else {
        gpu.run();
    }
    const StepClock clock = gpu.read_clock();
    const gpu::RowTables tables = gpu.system.buffers().tables();
    bool is_right = clock.is_full == 1 && clock.goes_on == 0 && clock.begun == clock.made + 1;
    is_right = is_right && clock.dropped_rows == (pairs_are_full ? 0u : 1u);
    for (const StepRow& row : tables.rows) is_right = is_right && row.node_0 == 7 && row.plane == 7;
    return error_if(!is_right);
}

// In a try for the guard alone all is as it was.
double guard_error(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    StartOnGpu gpu(at, inputs, expected.near);
    gpu.run();
    const gpu::RowTables before = gpu.system.buffers().tables();
    StepClock clock = gpu.read_clock();
    clock.guards = 1;
    gpu.state.tries.set_clock(clock);
    gpu.start.predict(gpu.buffers, nullptr);
    gpu.pairs->counts.upload(std::vector{PairCounts{}});
    gl::barrier(gl::Barrier::buffer_update);
    gpu.state.tries.set_count(pair_stages::kNearPairs, 0);
    gpu.start.find_rows(gpu.buffers, nullptr);
    gpu.start.linearise(gpu.buffers, nullptr);
    const gpu::RowTables after = gpu.system.buffers().tables();
    const bool has_changed =
        gpu.read_clock().goes_on != 1 || after.row_entries != before.row_entries ||
        after.entry_starts != before.entry_starts || after.island_of_object != before.island_of_object ||
        std::memcmp(after.rows.data(), before.rows.data(), after.rows.size() * sizeof(StepRow)) != 0;
    return error_if(has_changed);
}

// Of all objects, over their near pairs.
double guard_island_error(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    StartOnGpu gpu(at, inputs, expected.near);
    gpu.run();
    Numbers least(at.model->objects.size());
    for (std::uint32_t o = 0; o < least.size(); ++o) least[o] = o;
    for (std::size_t k = 0; k < least.size(); ++k)
        for (const cpu::NearPair<double>& near : expected.near.back().pairs)
            least[near.pair.object] = least[near.pair.other] =
                std::min(least[near.pair.object], least[near.pair.other]);
    gl::Buffer<std::uint32_t> labels(Numbers(least.size(), 77));
    gpu.pair_rows->find_guard_islands(labels);
    return error_if(downloaded(labels) != least);
}

// Tries that follow each other with nothing read between them, so that each waits for what the one before
// wrote.
void make_again(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    StartOnGpu gpu(at, inputs, expected.near);
    const gl::Buffer<BodyChange> changes(std::vector<BodyChange>(at.model->objects.size()));
    gpu.run();
    for (int k = 0; k < 2; ++k) {
        gpu.start.predict(gpu.buffers, nullptr);
        gpu.start.find_rows(gpu.buffers, nullptr);
        gpu.start.linearise(gpu.buffers, nullptr);
    }
    gpu.system.buffers().tables();
    gpu.pair_rows->note();
    gpu.pair_rows->remember(changes);
    gpu.pair_rows->forget();
}

constexpr float kQuarterFrame = 1.0f / 240.0f;

ColliderDescription plane_at(double height) {
    ColliderDescription plane;
    plane.shape = PlaneCollider{{0, 1, 0}, height};
    plane.friction = 0.3;
    return plane;
}

ColliderDescription belt_at(const glm::dvec3& position) {
    ColliderDescription belt;
    belt.shape = Shape(BoxShape{{0.4, 0.1, 0.4}});
    belt.position = position;
    belt.friction = 0.5;
    belt.surface_velocity = {0.3, 0.0, -0.2};
    return belt;
}

std::shared_ptr<const Model> shaken(const Model& model, float amount) {
    Model copy = model;
    shake_nodes(copy, amount);
    for (std::uint32_t n = 0; n < copy.node_count(); ++n)
        if (copy.positions[n].w == 0.0f && n < copy.body_node_count())  // of handles
            copy.velocities[n] = glm::vec4(0.2f, -0.1f, 0.05f, 0.0f);
    return std::make_shared<const Model>(std::move(copy));
}

constexpr double kGap = 0.003;       // [m]
constexpr double kFarFloor = -20.0;  // that no body reaches: its depth shortens no part [m]

// Three blocks above each other, the lowest held at a side, and two beside them, one of which is alone.
std::shared_ptr<const Model> make_stack(double fall = -0.3, double floor = 0.0) {
    const glm::dvec3 size(0.2);
    const glm::ivec3 cells{2, 2, 2};
    return shaken(
        *make_blocks(
            {{.cells = {3, 3, 3}, .size = size, .pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01}}},
             {.place = {0.05, 0.2 + kGap, 0.03}, .velocity = {0.1, fall, 0.0}, .cells = cells, .size = size},
             {.place = {1.0, 0.001, 0.0}, .velocity = {0.0, -0.1, 0.0}, .cells = cells, .size = size},
             {.place = {0.02, 0.4 + 2.0 * kGap, -0.04},
              .velocity = {0.0, 2.0 * fall, 0.1},
              .cells = cells,
              .size = size,
              .friction = 0.7},
             {.place = {1.2 + kGap, 0.002, 0.05},
              .velocity = {-0.2, 0.0, 0.0},
              .cells = cells,
              .size = size,
              .youngs_modulus = 2e5},
             {.place = {3.0, 1.0, 0.0}, .velocity = {0.0, 1.0, 0.0}, .cells = cells, .size = size}},
            {0.0, -9.81, 0.0}, {plane_at(floor)}),
        2e-4f);
}

// Bodies on a belt: two beside each other, one of them on the floor, too, and one apart from them on a corner
// of the belt, so that either has nodes on faces of the other. Near that one hangs another one, but what is
// near is held of both: no row makes an island of them.
std::shared_ptr<const Model> make_belt() {
    const glm::dvec3 size(0.2);
    const glm::ivec3 cells{2, 2, 2};
    return shaken(
        *make_blocks(
            {{.place = {0.1, kGap, 0.05}, .velocity = {0.0, -0.2, 0.1}, .cells = cells, .size = size},
             {.place = {0.3 + kGap, 0.002, 0.0}, .velocity = {-0.1, -0.3, 0.0}, .cells = cells, .size = size},
             {.place = {0.33, kGap, -0.15},
              .velocity = {0.0, -0.1, 0.0},
              .cells = cells,
              .size = 0.5 * size,
              .pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.331}}},
             {.place = {0.23 - kGap, 0.05, -0.14},
              .cells = cells,
              .size = 0.5 * size,
              .pins = {HalfSpaceRegion{{-1.0, 0.0, 0.0}, 0.001 - 0.33 + kGap}}}},
            {0.0, -9.81, 0.0}, {plane_at(0.0), belt_at({0.2, -0.05, 0.1})}),
        2e-4f);
}

// A bar that is a ring but for a gap, nearer to itself at rest than contacts reach, which closes at one side,
// and a block within it.
std::shared_ptr<const Model> make_ring() {
    TetMesh mesh = make_block({14, 1, 2}, {1.0, 0.04, 0.15}, 0.05, 3);
    const double radius = 0.5 / std::numbers::pi, part = 1.0 - 0.003 / (2.0 * std::numbers::pi * radius);
    for (glm::dvec3& p : mesh.positions) {
        const double angle = 2.0 * std::numbers::pi * part * p.x, distance = radius + p.y;
        p = {distance * std::cos(angle), -distance * std::sin(angle), p.z};
    }
    Body ring = make_body(mesh);
    ring.spin = {0.5, 1.0, -2.0};
    Body block = make_body(make_block({2, 2, 2}, glm::dvec3(0.1), 0.15, 4));
    for (glm::dvec3& p : block.mesh.positions) p += glm::dvec3(radius - 0.1 - kGap, -0.05, 0.02);
    block.velocity = {1.0, 0.2, 0.0};
    Model model = pack_bodies({ring, block}, {}, {0.0, -9.81, 0.0});
    for (std::uint32_t n = 0; n < model.objects[0].nodes.count; ++n)
        if (const glm::vec4 x = model.positions[n]; x.x > 0.0f)
            model.velocities[n].y += (x.y > 0.0f ? -1.4f : 1.4f) * x.z;
    return shaken(model, 2e-4f);
}

// Towers beside each other, of which some bodies are far from others.
std::shared_ptr<const Model> make_many() {
    std::vector<Block> blocks;
    for (int k = 0; k < 70; ++k)
        blocks.push_back(
            {.place = {0.3 * (k % 9) + 0.01 * (k % 2), 0.001 + (0.1 + kGap) * (k / 9), 0.01 * (k % 3)},
             .velocity = {0.0, -0.1 * (k % 4), 0.0},
             .cells = {1, 1, 1},
             .size = glm::dvec3(0.1)});
    return shaken(*make_blocks(blocks, {0, -9.81, 0}, {plane_at(0.0)}), 2e-4f);
}

StartCase with_pairs(const std::shared_ptr<const Model>& model, StartCase at = {}) {
    at.model = model;
    at.has_pairs = true;
    at.paces.resize(model->body_count());
    at.struck.resize(model->body_count());
    return at;
}

}  // namespace

Scenarios pair_rows_scenarios() {
    Scenarios scenarios;
    const auto add = [&](const char* name, const auto& make, const StartCase& at, const auto& error) {
        scenarios.push_back({name, [=] { return error(with_pairs(make(), at)); }});
    };
    const auto stack = [] { return make_stack(); };
    const StartCase known{.last_step = 0.9f * kQuarterFrame, .has_memory = true};
    // Those that find most errors come first.
    add("known_contacts_of_a_stack", stack, known, start_error);
    add("tables_of_a_stack", stack, known, table_error);
    add("belt", make_belt, known, start_error);
    add("tables_of_a_belt", make_belt, known, table_error);
    add("ring", make_ring, known, start_error);
    add("tables_of_a_ring", make_ring, known, table_error);
    add("memory_of_a_stack", stack, known, memory_error);
    add("memory_of_a_ring", make_ring, known, memory_error);
    add("tables_of_many", make_many, {}, table_error);
    add("many", make_many, {}, start_error);
    add("first_part", stack, {}, start_error);
    // No gap is what a contact reaches, but for rounding: only within are there dampers.
    add(
        "still_bodies_are_damped", [] { return make_stack(-0.3, -1e-3); },
        {.last_step = kQuarterFrame, .has_memory = true, .paces = {2, 2, 2, 2, 2, 2}}, start_error);
    add("islands_of_different_paces", stack, {.last_step = kQuarterFrame, .paces = {2, 2, 2, 1, 2, 0}},
        start_error);
    add("struck", stack, {.last_step = kQuarterFrame, .struck = {0, 0, 0, 1, 0, 0}}, start_error);
    add("divided", stack, {.size = 4.0f * kQuarterFrame, .divides = true, .last_step = kQuarterFrame},
        start_error);
    add("divided_in_two", stack,
        {.size = 4.0f * kQuarterFrame,
         .divides = true,
         .last_step = kQuarterFrame,
         .paces = {1, 1, 1, 1, 1, 2}},
        start_error);
    add(
        "too_deep", [] { return make_stack(-20.0, kFarFloor); },
        {.size = 4.0f * kQuarterFrame, .last_step = kQuarterFrame}, start_error);
    add(
        "too_fast", [] { return make_stack(-150.0, kFarFloor); },
        {.size = 4.0f * kQuarterFrame, .last_step = kQuarterFrame}, start_error);
    add("repeats", stack, known, repeat_error);
    add("guard_islands", make_belt, {}, guard_island_error);
    add("guard_islands_of_many", make_many, {}, guard_island_error);
    add("guard_alone", stack, known, guard_error);
    add("too_many_rows", stack, {}, [](const StartCase& at) { return overflow_error(at, false); });
    add("too_many_pairs", stack, {}, [](const StartCase& at) { return overflow_error(at, true); });
    return scenarios;
}

void run_pair_rows() {
    const StartCase at = with_pairs(make_belt(), {.last_step = 0.9f * kQuarterFrame, .has_memory = true});
    memory_error(at);
    guard_island_error(at);
    make_again(at);
}

}  // namespace gelatin::test
