#include "model/elasticity/element_edges.h"

#include <algorithm>
#include <array>
#include <utility>

#include "model/model.h"

namespace gelatin {
namespace {

template <class Entry>
using Rows = std::vector<std::vector<Entry>>;

// In slices of 64 rows.
template <class Entry>
void pack_rows(const Rows<Entry>& rows, const Entry& none, std::vector<std::uint32_t>& starts,
               std::vector<Entry>& entries) {
    constexpr std::uint32_t kSlice = packing::kSlice;
    starts = {0};
    for (std::size_t first = 0; first < rows.size(); first += kSlice) {
        const std::size_t end = std::min<std::size_t>(first + kSlice, rows.size());
        std::size_t most = 0;
        for (std::size_t r = first; r < end; ++r) most = std::max(most, rows[r].size());
        const std::uint32_t start = starts.back();
        starts.push_back(start + kSlice * static_cast<std::uint32_t>(most));
        entries.resize(starts.back(), none);
        for (std::size_t r = first; r < end; ++r)
            for (std::size_t k = 0; k < rows[r].size(); ++k)
                entries[start + kSlice * k + (r - first)] = rows[r][k];
    }
}

// Between two nodes, i < j: a spring, or 0, and one of its tets.
struct Part {
    std::uint32_t i, j;
    const Spring* spring;
    std::uint32_t tet;  // entry, if there is no spring

    std::pair<std::uint32_t, std::uint32_t> nodes() const { return {i, j}; }
};

// By their nodes; of the same nodes springs come first.
std::vector<Part> parts_of(const Model& model) {
    std::vector<Part> parts;
    for (const Spring& spring : model.springs)
        parts.push_back({std::min(spring.i, spring.j), std::max(spring.i, spring.j), &spring, 0});
    for (std::uint32_t t = 0; t < model.tets.size(); ++t) {
        for (std::uint32_t c = 0; c < 4; ++c) {
            for (std::uint32_t e = 0; e < 4; ++e) {
                const std::uint32_t i = model.tets[t][static_cast<int>(c)],
                                    j = model.tets[t][static_cast<int>(e)];
                if (i < j) parts.push_back({i, j, nullptr, 16 * t + 4 * c + e});
            }
        }
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.nodes() < b.nodes(); });
    return parts;
}

}  // namespace

ElementEdges make_element_edges(const Model& model) {
    const std::vector<Part> parts = parts_of(model);
    ElementEdges result;
    Rows<std::uint32_t> tets;
    for (std::size_t begin = 0, end = 0; begin < parts.size(); begin = end) {
        const std::size_t first_edge = result.edges.size();
        for (; end < parts.size() && parts[end].nodes() == parts[begin].nodes(); ++end) {
            const Part& part = parts[end];
            if (part.spring != nullptr) {
                result.edges.push_back({part.i, part.j, part.spring->rest_length, part.spring->stiffness});
            } else if (result.edges.size() == first_edge) {
                result.edges.push_back({part.i, part.j, 0.0f, 0.0f});
            }
            tets.resize(result.edges.size());
            if (part.spring == nullptr) tets[first_edge].push_back(part.tet);
        }
    }
    Rows<glm::uvec2> halves(model.node_count());
    for (std::uint32_t e = 0; e < result.edges.size(); ++e) {
        const auto& [lower, upper, rest_length, stiffness] = result.edges[e];
        halves[lower].emplace_back(2 * e, upper);
        halves[upper].emplace_back(2 * e + 1, lower);
    }
    pack_rows(tets, packing::kNone, result.tet_starts, result.tets);
    pack_rows(halves, glm::uvec2(packing::kNone), result.half_starts, result.halves);
    return result;
}

}  // namespace gelatin
