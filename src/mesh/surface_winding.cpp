#include "mesh/surface_winding.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

#include "mesh/edge_uses.h"

namespace gelatin {
namespace {

constexpr std::uint32_t kNone = ~0u;

// A connected set of faces: all[starts[p]] .. all[starts[p + 1]] are those of part p.
struct Parts {
    std::vector<std::uint32_t> faces, starts{0};
    std::vector<std::uint32_t> part_of_face;
    std::vector<bool> closed;

    std::uint32_t count() const { return static_cast<std::uint32_t>(starts.size() - 1); }
    std::span<const std::uint32_t> of(std::uint32_t part) const {
        return {faces.data() + starts[part], faces.data() + starts[part + 1]};
    }
};

// Side k of a face is the edge from its corner k to its corner k + 1.
struct Neighbour {
    std::uint32_t face = kNone;
    bool agrees = true;  // traverses the edge in the opposite direction, as it should
};
using Neighbours = std::vector<std::array<Neighbour, 3>>;

int side_of(const glm::uvec3& face, const EdgeUse& use) {
    const std::uint32_t from = use.ascending ? use.low : use.high;
    return face[0] == from ? 0 : face[1] == from ? 1 : 2;
}

Neighbours find_neighbours(const SurfaceMesh& mesh, std::span<const EdgeUse> uses) {
    Neighbours neighbours(mesh.faces.size());
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() != 2) return;
        const bool agrees = edge[0].ascending != edge[1].ascending;
        neighbours[edge[0].face][side_of(mesh.faces[edge[0].face], edge[0])] = {edge[1].face, agrees};
        neighbours[edge[1].face][side_of(mesh.faces[edge[1].face], edge[1])] = {edge[0].face, agrees};
    });
    return neighbours;
}

// Floods each part from its first face and decides which faces to flip for consistency with it.
Parts agree_within_parts(const Neighbours& neighbours, std::vector<bool>& turn, std::size_t& contrary_edges) {
    Parts parts;
    parts.part_of_face.assign(neighbours.size(), kNone);
    std::size_t contrary_sides = 0;
    for (std::uint32_t seed = 0; seed < neighbours.size(); ++seed) {
        if (parts.part_of_face[seed] != kNone) continue;
        const std::uint32_t part = parts.count();
        bool closed = true;
        parts.part_of_face[seed] = part;
        parts.faces.push_back(seed);
        for (std::size_t next = parts.starts.back(); next < parts.faces.size(); ++next) {
            const std::uint32_t face = parts.faces[next];
            for (const Neighbour& neighbour : neighbours[face]) {
                if (neighbour.face == kNone) {
                    closed = false;
                    continue;
                }
                const bool wanted = turn[face] == neighbour.agrees;
                if (parts.part_of_face[neighbour.face] == kNone) {
                    parts.part_of_face[neighbour.face] = part;
                    turn[neighbour.face] = wanted;
                    parts.faces.push_back(neighbour.face);
                } else if (turn[neighbour.face] != wanted) {
                    ++contrary_sides;
                }
            }
        }
        parts.starts.push_back(static_cast<std::uint32_t>(parts.faces.size()));
        parts.closed.push_back(closed);
    }
    contrary_edges = contrary_sides / 2;
    return parts;
}

// The middle of a part's boundary, by length; of a closed part its first vertex.
glm::dvec3 middle_of_boundary(const SurfaceMesh& mesh, std::span<const std::uint32_t> faces,
                              const Neighbours& neighbours) {
    glm::dvec3 sum(0.0);
    double length = 0.0;
    for (const std::uint32_t f : faces) {
        for (int side = 0; side < 3; ++side) {
            if (neighbours[f][side].face != kNone) continue;
            const glm::dvec3 &a = mesh.positions[mesh.faces[f][side]],
                             &b = mesh.positions[mesh.faces[f][(side + 1) % 3]];
            const double weight = glm::distance(a, b);
            sum += weight * 0.5 * (a + b);
            length += weight;
        }
    }
    return length > 0.0 ? sum / length : mesh.positions[mesh.faces[faces[0]][0]];
}

// Six times the volume [m^3]. Holes of an open part are closed by cones to the middle of its boundary.
double part_volume(const SurfaceMesh& mesh, std::span<const std::uint32_t> faces,
                   const Neighbours& neighbours, const std::vector<bool>& turn) {
    const glm::dvec3 origin = middle_of_boundary(mesh, faces, neighbours);
    double volume = 0.0;
    for (const std::uint32_t f : faces) {
        const glm::uvec3& face = mesh.faces[f];
        const glm::dvec3 a = mesh.positions[face[0]] - origin, b = mesh.positions[face[1]] - origin,
                         c = mesh.positions[face[2]] - origin;
        volume += (turn[f] ? -1.0 : 1.0) * dot(a, cross(b, c));
    }
    return volume;
}

// Finds whether a vertex of a part is inside an odd number of other parts: by the parity of the faces that
// the ray along +x from it crosses.
struct Query {
    glm::dvec3 from;
    std::uint32_t part;
    bool odd = false;
};

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

// The part's extreme vertices along the axes. If parts merely overlap, one of these is outside.
std::array<glm::dvec3, 6> extremes(const SurfaceMesh& mesh, std::span<const std::uint32_t> faces) {
    std::array<glm::dvec3, 6> points;
    points.fill(mesh.positions[mesh.faces[faces[0]][0]]);
    for (const std::uint32_t f : faces) {
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3& p = mesh.positions[mesh.faces[f][corner]];
            for (int axis = 0; axis < 3; ++axis) {
                if (p[axis] < points[2 * axis][axis]) points[2 * axis] = p;
                if (p[axis] > points[2 * axis + 1][axis]) points[2 * axis + 1] = p;
            }
        }
    }
    return points;
}

std::vector<bool> find_cavities(const SurfaceMesh& mesh, const Parts& parts) {
    std::vector<bool> cavity(parts.count(), false);
    if (std::count(parts.closed.begin(), parts.closed.end(), true) < 2) return cavity;

    std::vector<Query> queries;
    for (std::uint32_t part = 0; part < parts.count(); ++part) {
        if (!parts.closed[part]) continue;
        cavity[part] = true;
        for (const glm::dvec3& p : extremes(mesh, parts.of(part))) queries.push_back({p, part});
    }
    // Sorted by y, so that a face tests only the queries in its range.
    std::sort(queries.begin(), queries.end(),
              [](const Query& a, const Query& b) { return a.from.y < b.from.y; });
    for (const std::uint32_t f : parts.faces) {
        if (!parts.closed[parts.part_of_face[f]]) continue;
        const glm::uvec3& face = mesh.faces[f];
        const auto [low, high] =
            std::minmax({mesh.positions[face[0]].y, mesh.positions[face[1]].y, mesh.positions[face[2]].y});
        auto query = std::lower_bound(queries.begin(), queries.end(), low,
                                      [](const Query& q, double y) { return q.from.y < y; });
        for (; query != queries.end() && query->from.y <= high; ++query) {
            if (query->part != parts.part_of_face[f] && ray_crosses(mesh, face, query->from))
                query->odd = !query->odd;
        }
    }
    for (const Query& query : queries) {
        if (!query.odd) cavity[query.part] = false;
    }
    return cavity;
}

}  // namespace

WindingRepair orient_faces_outward(SurfaceMesh& mesh) {
    WindingRepair repair;
    std::vector<bool> turn(mesh.faces.size(), false);
    const std::vector<EdgeUse> uses = sorted_edge_uses(mesh.faces);
    const Neighbours neighbours = find_neighbours(mesh, uses);
    const Parts parts = agree_within_parts(neighbours, turn, repair.contrary_edges);
    const std::vector<bool> cavity = find_cavities(mesh, parts);
    for (std::uint32_t part = 0; part < parts.count(); ++part) {
        const double volume = part_volume(mesh, parts.of(part), neighbours, turn);
        if (cavity[part] ? volume <= 0.0 : volume >= 0.0) continue;
        for (const std::uint32_t f : parts.of(part)) turn[f] = !turn[f];
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (!turn[f]) continue;
        std::swap(mesh.faces[f][1], mesh.faces[f][2]);
        if (!mesh.look.corner_uvs.empty()) std::swap(mesh.look.corner_uvs[f][1], mesh.look.corner_uvs[f][2]);
        ++repair.flipped_faces;
    }
    return repair;
}

}  // namespace gelatin
