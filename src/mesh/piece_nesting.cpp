#include "mesh/piece_nesting.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace gelatin {
namespace {

// Whether the edge a-b, projected along x, crosses the ray along +y from `from`. Both faces of an edge get
// the same answer, so that no ray slips through between them. The crossing is clamped to both ends against
// rounding.
bool crosses_in_projection(const SurfaceMesh& mesh, std::uint32_t a, std::uint32_t b,
                           const glm::dvec3& from) {
    if (a > b) std::swap(a, b);
    const glm::dvec3 &p = mesh.positions[a], &q = mesh.positions[b];
    if ((p.z > from.z) == (q.z > from.z)) return false;
    const double crossing = p.y + (from.z - p.z) / (q.z - p.z) * (q.y - p.y);
    return std::clamp(crossing, std::min(p.y, q.y), std::max(p.y, q.y)) > from.y;
}

bool ray_crosses(const SurfaceMesh& mesh, const glm::uvec3& face, const glm::dvec3& from) {
    const bool hit = crosses_in_projection(mesh, face[0], face[1], from) ^
                     crosses_in_projection(mesh, face[1], face[2], from) ^
                     crosses_in_projection(mesh, face[2], face[0], from);
    if (!hit) return false;
    const glm::dvec3& a = mesh.positions[face[0]];
    const glm::dvec3 normal = cross(mesh.positions[face[1]] - a, mesh.positions[face[2]] - a);
    return dot(normal, a - from) * normal.x > 0.0;
}

/// Where a vertex of a piece is: by the parity of the faces of another piece that the ray along +x from it
/// crosses.
struct Query {
    std::uint32_t vertex, piece;
    struct Place {
        bool is_inside = false, is_on = false;
    };
    std::map<std::uint32_t, Place> places = {};  // by piece
};

// The extreme vertices of each piece along the axes. If pieces merely overlap, one of these is outside.
std::vector<Query> make_queries(const SurfaceMesh& mesh, std::span<const std::uint32_t> piece_of_face,
                                std::uint32_t piece_count) {
    std::vector<std::array<std::uint32_t, 6>> extremes(piece_count);
    for (auto& of_piece : extremes) of_piece.fill(~0u);
    for (std::size_t f = 0; f < piece_of_face.size(); ++f) {
        if (piece_of_face[f] == kNoPiece) continue;
        for (int k = 0; k < 18; ++k) {
            const std::uint32_t vertex = mesh.faces[f][k / 6];
            const int axis = k % 6 / 2;
            const double sign = k % 2 == 0 ? 1.0 : -1.0;
            std::uint32_t& best = extremes[piece_of_face[f]][static_cast<std::size_t>(k % 6)];
            if (best == ~0u || sign * mesh.positions[vertex][axis] < sign * mesh.positions[best][axis])
                best = vertex;
        }
    }
    std::vector<Query> queries;
    for (std::uint32_t piece = 0; piece < piece_count; ++piece) {
        for (const std::uint32_t vertex : extremes[piece]) queries.push_back({vertex, piece});
    }
    return queries;
}

// The pieces in which all queries of a piece are that are not on them.
std::vector<std::uint32_t> common_containers(std::span<const Query> queries) {
    std::map<std::uint32_t, std::size_t> votes;
    for (const Query& query : queries) {
        for (const auto& [piece, place] : query.places) votes[piece] += place.is_inside || place.is_on;
    }
    std::vector<std::uint32_t> containers;
    for (const auto& [piece, count] : votes) {
        const bool is_anywhere_inside =
            std::any_of(queries.begin(), queries.end(), [&, at = piece](const Query& query) {
                const auto place = query.places.find(at);
                return place != query.places.end() && place->second.is_inside && !place->second.is_on;
            });
        if (count == queries.size() && is_anywhere_inside) containers.push_back(piece);
    }
    return containers;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> find_containers(const SurfaceMesh& mesh,
                                                        std::span<const std::uint32_t> piece_of_face,
                                                        std::uint32_t piece_count) {
    std::vector<std::vector<std::uint32_t>> containers(piece_count);
    if (piece_count < 2) return containers;
    std::vector<Query> queries = make_queries(mesh, piece_of_face, piece_count);
    // Sorted by y, so that a face tests only the queries in its range.
    const auto y_of = [&](const Query& query) { return mesh.positions[query.vertex].y; };
    std::sort(queries.begin(), queries.end(),
              [&](const Query& a, const Query& b) { return y_of(a) < y_of(b); });
    for (std::size_t f = 0; f < piece_of_face.size(); ++f) {
        const std::uint32_t piece = piece_of_face[f];
        if (piece == kNoPiece) continue;
        const glm::uvec3& face = mesh.faces[f];
        const auto [low, high] =
            std::minmax({mesh.positions[face[0]].y, mesh.positions[face[1]].y, mesh.positions[face[2]].y});
        auto query = std::lower_bound(queries.begin(), queries.end(), low,
                                      [&](const Query& q, double y) { return y_of(q) < y; });
        for (; query != queries.end() && y_of(*query) <= high; ++query) {
            if (query->piece == piece) continue;
            if (face[0] == query->vertex || face[1] == query->vertex || face[2] == query->vertex)
                query->places[piece].is_on = true;
            else if (ray_crosses(mesh, face, mesh.positions[query->vertex]))
                query->places[piece].is_inside ^= true;
        }
    }
    std::stable_sort(queries.begin(), queries.end(),
                     [](const Query& a, const Query& b) { return a.piece < b.piece; });
    constexpr std::size_t kEach = 6;
    for (std::uint32_t piece = 0; piece < piece_count; ++piece)
        containers[piece] = common_containers(std::span<const Query>(queries).subspan(kEach * piece, kEach));
    return containers;
}

}  // namespace gelatin
