#include "model/elasticity/node_tets.h"

#include <algorithm>
#include <numeric>

#include "model/model.h"
#include "model/spring_packing.h"

namespace gelatin {
namespace {

constexpr std::uint32_t kNoTet = 0xFFFFFFFFu;

}  // namespace

NodeTets make_node_tets(std::uint32_t node_count, std::span<const glm::uvec4> tets) {
    NodeTets result;
    result.starts.assign(node_count + 1, 0);
    for (const glm::uvec4& tet : tets) {
        for (int k = 0; k < 4; ++k) ++result.starts[tet[k] + 1];
    }
    std::partial_sum(result.starts.begin(), result.starts.end(), result.starts.begin());

    result.entries.resize(4 * tets.size());
    std::vector<std::uint32_t> next(result.starts.begin(), result.starts.end() - 1);
    for (std::uint32_t t = 0; t < tets.size(); ++t) {
        for (std::uint32_t k = 0; k < 4; ++k)
            result.entries[next[tets[t][static_cast<int>(k)]]++] = 4 * t + k;
    }
    return result;
}

NodeTetSlices pack_node_tets(std::span<const std::uint32_t> rows, const NodeTets& node_tets) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const auto entries_of = [&](std::uint32_t n) {
        if (n == kNoNode) return std::span<const std::uint32_t>();
        return std::span(node_tets.entries)
            .subspan(node_tets.starts[n], node_tets.starts[n + 1] - node_tets.starts[n]);
    };
    NodeTetSlices packed;
    packed.slice_starts.push_back(0);
    for (std::size_t first = 0; first < rows.size(); first += kSlice) {
        const std::size_t end = std::min(first + kSlice, rows.size());
        const std::uint32_t start = packed.slice_starts.back();
        std::size_t most = 0;
        for (std::size_t r = first; r < end; ++r) most = std::max(most, entries_of(rows[r]).size());
        packed.slice_starts.push_back(start + kSlice * static_cast<std::uint32_t>(most));
        packed.entries.resize(packed.slice_starts.back(), NodeTetSlices::kNoEntry);
        for (std::size_t r = first; r < end; ++r) {
            std::size_t at = start + (r - first);
            for (const std::uint32_t entry : entries_of(rows[r])) {
                packed.entries[at] = entry;
                at += kSlice;
            }
        }
    }
    return packed;
}

TetCorners pack_tet_corners(std::span<const std::uint32_t> rows, const NodeTets& node_tets,
                            std::span<const glm::uvec4> tets) {
    constexpr std::uint32_t kSlice = TetCorners::kSlice;
    static_assert(kSlice == HalfSprings::kSlice);
    const auto count_of = [&](std::uint32_t n) {
        return n == kNoNode ? 0 : node_tets.starts[n + 1] - node_tets.starts[n];
    };
    const auto row_count = static_cast<std::uint32_t>(rows.size());
    TetCorners packed;
    packed.slice_starts.push_back(0);
    for (std::uint32_t first = 0; first < row_count; first += kSlice) {
        const std::uint32_t end = std::min(first + kSlice, row_count), start = packed.slice_starts.back();
        std::uint32_t most = 0;
        for (std::uint32_t r = first; r < end; ++r) most = std::max(most, count_of(rows[r]));
        packed.slice_starts.push_back(start + kSlice * most);
        packed.corners.resize(packed.slice_starts.back(), TetCorner{0, 0, 0, kNoTet});
        for (std::uint32_t r = first; r < end; ++r) {
            for (std::uint32_t k = 0; k < count_of(rows[r]); ++k) {
                const std::uint32_t entry = node_tets.entries[node_tets.starts[rows[r]] + k];
                const glm::uvec4& tet = tets[entry / 4];
                const auto& opposite = kOppositeCorners[entry % 4];
                packed.corners[start + kSlice * k + (r - first)] = {tet[opposite[0]], tet[opposite[1]],
                                                                    tet[opposite[2]], entry / 4};
            }
        }
    }
    return packed;
}

}  // namespace gelatin
