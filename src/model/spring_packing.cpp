#include "model/spring_packing.h"

#include <algorithm>
#include <numeric>

namespace gelatin {

namespace {

// @param nodes nodes(s) gives the two nodes of spring s
template <class Nodes>
SpringIncidence incidence_of(std::uint32_t node_count, std::size_t spring_count, const Nodes& nodes) {
    SpringIncidence incidence;
    incidence.starts.assign(node_count + 1, 0);
    for (std::uint32_t s = 0; s < spring_count; ++s) {
        ++incidence.starts[nodes(s).x + 1];
        ++incidence.starts[nodes(s).y + 1];
    }
    for (std::uint32_t n = 0; n < node_count; ++n) incidence.starts[n + 1] += incidence.starts[n];
    incidence.entries.resize(2 * spring_count);
    std::vector<std::uint32_t> next(incidence.starts.begin(), incidence.starts.end() - 1);
    for (std::uint32_t s = 0; s < spring_count; ++s) {
        incidence.entries[next[nodes(s).x]++] = 2 * s;
        incidence.entries[next[nodes(s).y]++] = 2 * s + 1;
    }
    return incidence;
}

}  // namespace

SpringIncidence make_incidence(std::uint32_t node_count, std::span<const Spring> springs) {
    return incidence_of(node_count, springs.size(),
                        [&](std::uint32_t s) { return glm::uvec2(springs[s].i, springs[s].j); });
}

SpringIncidence make_incidence(std::uint32_t node_count, std::span<const glm::uvec2> spring_nodes) {
    return incidence_of(node_count, spring_nodes.size(), [&](std::uint32_t s) { return spring_nodes[s]; });
}

HalfSprings pack_half_springs(std::span<const std::uint32_t> rows, std::span<const Spring> springs) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    std::uint32_t node_count = 0;
    for (const Spring& spring : springs) node_count = std::max({node_count, spring.i + 1, spring.j + 1});
    for (const std::uint32_t n : rows) node_count = n == kNoNode ? node_count : std::max(node_count, n + 1);
    const SpringIncidence incidence = make_incidence(node_count, springs);
    const auto count_of = [&](std::uint32_t n) {
        return n == kNoNode ? 0 : incidence.starts[n + 1] - incidence.starts[n];
    };
    const auto row_count = static_cast<std::uint32_t>(rows.size());
    HalfSprings packed;
    packed.slice_starts.push_back(0);
    for (std::uint32_t first = 0; first < row_count; first += kSlice) {
        const std::uint32_t end = std::min(first + kSlice, row_count);
        std::uint32_t most = 0;
        for (std::uint32_t r = first; r < end; ++r) most = std::max(most, count_of(rows[r]));

        const std::uint32_t start = packed.slice_starts.back();
        packed.slice_starts.push_back(start + kSlice * ((most + 1) / 2));
        packed.stiffness.resize(packed.slice_starts.back(), glm::vec2(0.0f));
        for (std::uint32_t p = start; p < packed.slice_starts.back(); ++p) {
            // Rows without a node, and the padding after the last row, refer to a node that exists.
            const std::uint32_t self = rows[std::min(first + (p - start) % kSlice, row_count - 1)];
            const std::uint32_t shown = self == kNoNode ? 0 : self;
            packed.pairs.push_back({shown, 0.0f, shown, 0.0f});
        }
        for (std::uint32_t r = first; r < end; ++r) {
            const std::uint32_t n = rows[r];
            for (std::uint32_t k = 0; k < count_of(n); ++k) {
                const std::uint32_t entry = incidence.entries[incidence.starts[n] + k];
                const Spring& spring = springs[entry / 2];
                const std::uint32_t other = entry % 2 == 0 ? spring.j : spring.i;
                const std::uint32_t at = start + kSlice * (k / 2) + (r - first);
                HalfSpringPair& pair = packed.pairs[at];
                (k % 2 == 0 ? pair.node_0 : pair.node_1) = other;
                (k % 2 == 0 ? pair.rest_length_0 : pair.rest_length_1) = spring.rest_length;
                packed.stiffness[at][static_cast<int>(k % 2)] = spring.stiffness;
            }
        }
    }
    return packed;
}

HalfSprings pack_half_springs(std::uint32_t node_count, std::span<const Spring> springs) {
    std::vector<std::uint32_t> rows(node_count);
    std::iota(rows.begin(), rows.end(), 0u);
    return pack_half_springs(rows, springs);
}

}  // namespace gelatin
