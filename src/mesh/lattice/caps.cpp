#include "mesh/lattice/caps.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "mesh/edge_uses.h"

namespace gelatin::lattice {
namespace {

struct OpenEdge {
    std::uint32_t from, to;
};

// The edges of the caps: against the direction in which faces use them more often, by their starts.
std::vector<OpenEdge> find_open_edges(std::span<const glm::uvec3> faces) {
    std::vector<OpenEdge> edges;
    const std::vector<EdgeUse> uses = sorted_edge_uses(faces);
    for_each_edge(std::span<const EdgeUse>(uses), [&](std::span<const EdgeUse> edge) {
        const EdgeUse& use = edge.front();
        if (use.low == use.high) return;
        const auto ascending =
            std::count_if(edge.begin(), edge.end(), [](const EdgeUse& u) { return u.ascending; });
        const auto excess = 2 * ascending - static_cast<std::ptrdiff_t>(edge.size());
        const OpenEdge cap = excess > 0 ? OpenEdge{use.high, use.low} : OpenEdge{use.low, use.high};
        edges.insert(edges.end(), static_cast<std::size_t>(std::abs(excess)), cap);
    });
    std::stable_sort(edges.begin(), edges.end(),
                     [](const OpenEdge& a, const OpenEdge& b) { return a.from < b.from; });
    return edges;
}

// Of the part of a loop between two of its vertices, closed by the line between these.
void close_part(std::span<const std::uint32_t> part, std::vector<glm::uvec3>& caps) {
    if (part.size() < 3) return;
    const std::size_t middle = part.size() / 2;
    caps.emplace_back(part.front(), part[middle], part.back());
    close_part(part.first(middle + 1), caps);
    close_part(part.subspan(middle), caps);
}

}  // namespace

// As many edges start at a vertex as end there, so that a path along edges not used yet ends where it began.
// Whenever it comes to a vertex that it has been at, the loop since then is closed and taken from it.
std::vector<glm::uvec3> find_caps(std::span<const glm::uvec3> faces) {
    const std::vector<OpenEdge> edges = find_open_edges(faces);
    struct Vertex {
        std::size_t next;             // its first edge that is not used yet
        std::ptrdiff_t on_path = -1;  // where
    };
    std::unordered_map<std::uint32_t, Vertex> vertices;
    for (std::size_t e = edges.size(); e-- > 0;) vertices[edges[e].from].next = e;
    std::vector<glm::uvec3> caps;
    std::vector<std::uint32_t> path;
    for (const OpenEdge& start : edges) {
        for (std::uint32_t at = start.from;;) {
            Vertex& vertex = vertices[at];
            if (vertex.on_path >= 0) {
                const auto loop = std::span(path).subspan(static_cast<std::size_t>(vertex.on_path));
                close_part(loop, caps);
                for (const std::uint32_t v : loop) vertices[v].on_path = -1;
                path.resize(path.size() - loop.size());
            }
            if (vertex.next == edges.size() || edges[vertex.next].from != at) break;
            vertex.on_path = static_cast<std::ptrdiff_t>(path.size());
            path.push_back(at);
            at = edges[vertex.next++].to;
        }
    }
    return caps;
}

}  // namespace gelatin::lattice
