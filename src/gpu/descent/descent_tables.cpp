#include "gpu/descent/descent_tables.h"

#include <algorithm>
#include <bit>

#include "model/elasticity/neo_hookean.h"

namespace gelatin::gpu {
namespace {

// Pairs of half springs that the row's slice has for it.
std::uint32_t pair_count(const HalfSprings& springs, std::uint32_t row) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const std::uint32_t slice = row / kSlice, first = springs.slice_starts[slice] + row % kSlice;
    std::uint32_t count = (springs.slice_starts[slice + 1] - springs.slice_starts[slice]) / kSlice;
    while (count > 0 && springs.stiffness[first + (count - 1) * kSlice] == glm::vec2(0.0f)) --count;
    return count;
}

}  // namespace

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

std::vector<DescentRow> rows_of(const DescentRows& rows, const Model& model) {
    const std::vector<std::uint32_t> objects = objects_of_nodes(model), places = places_on_surface(model);
    std::vector<DescentRow> result;
    for (std::uint32_t r = 0; r < rows.nodes.size(); ++r) {
        const std::uint32_t n = rows.nodes[r];
        DescentRow row{n, 0, pair_count(rows.springs, r), kNoNode};
        if (n != kNoNode) {
            row.object = objects[n];
            row.place = places[n];
        }
        result.push_back(row);
    }
    return result;
}

std::vector<std::uint32_t> rows_of_springs(const Model& model, std::span<const std::uint32_t> rows) {
    std::vector<std::uint32_t> result(rows.begin(), rows.end());
    for (std::uint32_t& node : result) {
        if (node != kNoNode && has_neo_hookean_tets(model, node)) node = kNoNode;
    }
    return result;
}

VolumeShares volume_shares_of(const Model& model, const NodeTets& node_tets) {
    constexpr std::uint32_t kSlice = packing::kSlice;
    const std::vector<std::uint32_t>& starts = node_tets.starts;
    VolumeShares shares{{0}, {}};
    for (std::uint32_t first = 0; first < model.node_count(); first += kSlice) {
        const std::uint32_t end = std::min(first + kSlice, model.node_count());
        std::uint32_t most = 0;
        for (std::uint32_t n = first; n < end; ++n) most = std::max(most, starts[n + 1] - starts[n]);
        const std::uint32_t start = shares.slice_starts.back();
        shares.slice_starts.push_back(start + kSlice * ((most + 1) / 2));
        shares.pairs.resize(shares.slice_starts.back(), glm::uvec4(0));
        for (std::uint32_t n = first; n < end; ++n) {
            for (std::uint32_t k = 0; k < starts[n + 1] - starts[n]; ++k) {
                const std::uint32_t tet = node_tets.entries[starts[n] + k] / 4;
                const float share = 0.25f * model.tet_rests[tet].volume / model.volume_term.nodes[n].x;
                glm::uvec4& pair = shares.pairs[start + kSlice * (k / 2) + (n - first)];
                (k % 2 == 0 ? pair.x : pair.z) = tet;
                (k % 2 == 0 ? pair.y : pair.w) = std::bit_cast<std::uint32_t>(share);
            }
        }
    }
    return shares;
}

TetCorners corners_of(const Model& model, std::span<const std::uint32_t> rows) {
    return pack_tet_corners(rows_of_springs(model, rows), make_node_tets(model.node_count(), model.tets),
                            model.tets);
}

}  // namespace gelatin::gpu
