#include "gpu/implicit/row_tables.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

// Of entries (key, value), in order: where each key's begin, and the values.
void index_by_key(const std::vector<glm::uvec2>& entries, std::size_t keys,
                  std::vector<std::uint32_t>& starts, std::vector<std::uint32_t>& values) {
    starts.assign(keys + 1, 0u);
    for (const glm::uvec2& entry : entries) ++starts[entry.x + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    values.resize(entries.size());
    for (const glm::uvec2& entry : entries) values[next[entry.x]++] = entry.y;
}

// Bodies and chunks of their nodes.
void add_islands(std::span<const std::uint32_t> islands_of_bodies,
                 std::span<const std::uint32_t> chunk_starts, RowTables& tables) {
    std::vector<glm::uvec2> entries;  // island, body
    std::uint32_t count = 0;
    for (std::uint32_t o = 0; o < islands_of_bodies.size(); ++o) {
        const std::uint32_t least = islands_of_bodies[o];
        if (least == packing::kNone) continue;
        tables.island_of_object[o] = least == o ? count++ : tables.island_of_object[least];
        entries.emplace_back(tables.island_of_object[o], o);
    }
    std::vector<std::uint32_t> starts;
    index_by_key(entries, count, starts, tables.island_bodies);
    for (std::uint32_t i = 0; i < count; ++i) {
        StepIsland& island = tables.islands[i];
        island.first_body = starts[i];
        island.body_end = starts[i + 1];
        island.first_chunk = static_cast<std::uint32_t>(tables.island_chunks.size());
        for (std::uint32_t k = starts[i]; k < starts[i + 1]; ++k) {
            const std::uint32_t o = tables.island_bodies[k];
            for (std::uint32_t c = chunk_starts[o]; c < chunk_starts[o + 1]; ++c)
                tables.island_chunks.push_back(c);
        }
        island.chunk_end = static_cast<std::uint32_t>(tables.island_chunks.size());
    }
}

// Of the side that has one.
std::uint32_t island_of(const RowTables& tables, std::uint32_t object, std::uint32_t other) {
    const bool has_island =
        other < tables.island_of_object.size() && tables.island_of_object[other] != packing::kNone;
    return tables.island_of_object[has_island ? other : object];
}

void sort_rows(std::span<const StepRow> rows, RowTables& tables) {
    using Key = std::array<std::uint32_t, 4>;  // island, object, other, row
    std::vector<Key> keys;
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const auto& [object, other] = std::pair(rows[r].object, rows[r].other);
        keys.push_back({island_of(tables, object, other), object, other, r});
    }
    std::sort(keys.begin(), keys.end());
    for (const Key& key : keys) tables.rows.push_back(rows[key[3]]);
}

// Pairs, their chunks, and the parts of both that islands have.
void add_pairs(std::uint32_t object_count, RowTables& tables) {
    const auto count = static_cast<std::uint32_t>(tables.rows.size());
    const auto end_of_pairs = [&] { return static_cast<std::uint32_t>(tables.pairs.size()); };
    const auto end_of_chunks = [&] { return static_cast<std::uint32_t>(tables.row_chunks.size()); };
    std::vector<glm::uvec2> couplings;
    std::uint32_t next = 0;
    for (std::uint32_t r = 0; r < count; r = next) {
        const std::uint32_t object = tables.rows[r].object, other = tables.rows[r].other;
        const auto place_of = [&](std::uint32_t o) {
            const bool moves = o < object_count && tables.island_of_object[o] != packing::kNone;
            return moves && object != other ? o : object_count;
        };
        StepPair pair{place_of(object), place_of(other), end_of_chunks(), 0};
        StepIsland& island = tables.islands[island_of(tables, object, other)];
        if (island.first_row == island.row_end) {
            island.first_row = r;
            island.first_row_chunk = end_of_chunks();
            island.first_pair = end_of_pairs();
        }
        for (next = r; next < count && tables.rows[next].object == object && tables.rows[next].other == other;
             ++next) {
            if ((next - r) % contact_tuning::kRowsOfChunk == 0) tables.row_chunks.emplace_back(next, next);
            tables.row_chunks.back().y = next + 1;
        }
        for (std::uint32_t k = r; k < next; ++k) {
            tables.rows[k].object = pair.object;
            tables.rows[k].other = pair.other;
        }
        pair.chunk_end = end_of_chunks();
        for (std::uint32_t side = 0; side < 2; ++side)
            if (const std::uint32_t o = side == 0 ? pair.object : pair.other; o < object_count)
                couplings.emplace_back(o, 2 * end_of_pairs() + side);
        tables.pairs.push_back(pair);
        island.row_end = next;
        island.row_chunk_end = end_of_chunks();
        island.pair_end = end_of_pairs();
    }
    index_by_key(couplings, object_count, tables.coupling_starts, tables.couplings);
}

}  // namespace

RowTables make_row_tables(const RowTableSizes& sizes, std::span<const StepRow> rows,
                          std::span<const std::uint32_t> islands_of_bodies) {
    RowTables tables;
    const std::uint32_t objects = sizes.objects;
    tables.islands.resize(objects);
    tables.island_of_object.assign(objects, packing::kNone);
    add_islands(islands_of_bodies, sizes.chunk_starts, tables);
    sort_rows(rows, tables);
    add_pairs(objects, tables);
    std::vector<glm::uvec2> entries;
    for (std::uint32_t r = 0; r < tables.rows.size(); ++r) {
        const StepRow& row = tables.rows[r];
        const std::array<std::uint32_t, 4> nodes{row.node_0, row.node_1, row.node_2, row.node_3};
        for (std::uint32_t k = 0; k < 4; ++k)
            if (row.weights[static_cast<int>(k)] != 0.0f) entries.emplace_back(nodes[k], 4 * r + k);
    }
    index_by_key(entries, sizes.nodes, tables.entry_starts, tables.row_entries);
    return tables;
}

}  // namespace gelatin::gpu
