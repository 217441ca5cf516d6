#include "mesh/surface_winding.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <utility>

#include "mesh/edge_uses.h"
#include "mesh/piece_nesting.h"

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

/// What becomes of a part of the surface.
struct Role {
    bool is_inward = false;
    bool is_enclosed = false;  ///< the same is on both of its sides: a body
};

/// Decides about closed parts inside closed parts by their orientation in the file. `winding` is how many
/// bodies a place is in, less how many cavities: around a part that of all parts that contain it.
class Nesting {
public:
    Nesting(const SurfaceMesh& mesh, const Parts& parts, const std::vector<double>& volumes,
            const std::vector<bool>& turn, WindingRepair& repair)
        : parts_(parts), volumes_(volumes), turn_(turn), repair_(repair), roles_(parts.count()) {
        find_pieces();
        containers_ = find_containers(mesh, piece_of_face_, static_cast<std::uint32_t>(pieces_.size()));
    }

    std::vector<Role> decide() {
        std::vector<std::uint32_t> order(pieces_.size());  // containers before what they contain
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return containers_[a].size() < containers_[b].size();
        });
        for (const std::uint32_t piece : order) decide(piece);
        return std::move(roles_);
    }

private:
    void find_pieces() {
        piece_of_face_.assign(parts_.part_of_face.size(), kNoPiece);
        for (std::uint32_t part = 0; part < parts_.count(); ++part) {
            if (!parts_.closed[part]) continue;
            for (const std::uint32_t f : parts_.of(part))
                piece_of_face_[f] = static_cast<std::uint32_t>(pieces_.size());
            pieces_.push_back(part);
        }
    }

    Role& role(std::uint32_t piece) { return roles_[pieces_[piece]]; }

    // As most faces have it in the file.
    bool is_inward_in_file(std::uint32_t piece) const {
        const std::uint32_t part = pieces_[piece];
        const auto faces = parts_.of(part);
        const auto turned = std::count_if(faces.begin(), faces.end(), [&](auto f) { return turn_[f]; });
        return (volumes_[part] < 0.0) != (2 * static_cast<std::size_t>(turned) > faces.size());
    }

    void decide(std::uint32_t piece) {
        const std::vector<std::uint32_t>& around = containers_[piece];
        if (around.empty()) return;
        int winding = 0;
        std::uint32_t innermost = around.front();
        for (const std::uint32_t container : around) {
            winding += role(container).is_inward ? -1 : 1;
            if (containers_[container].size() > containers_[innermost].size()) innermost = container;
        }
        if (winding <= 0) {
            ++repair_.enclosed_bodies;
            return;
        }
        const bool is_opposite = is_inward_in_file(piece) != is_inward_in_file(innermost);
        role(piece).is_inward = is_opposite != role(innermost).is_inward;
        role(piece).is_enclosed = !role(piece).is_inward || winding > 1;
        ++(role(piece).is_enclosed ? repair_.overlapping_bodies : repair_.cavities);
    }

    const Parts& parts_;
    const std::vector<double>& volumes_;
    const std::vector<bool>& turn_;
    WindingRepair& repair_;
    std::vector<Role> roles_;
    std::vector<std::uint32_t> pieces_;  ///< the closed parts
    std::vector<std::uint32_t> piece_of_face_;
    std::vector<std::vector<std::uint32_t>> containers_;
};

}  // namespace

WindingRepair orient_faces_outward(SurfaceMesh& mesh) {
    WindingRepair repair;
    std::vector<bool> turn(mesh.faces.size(), false);
    const std::vector<EdgeUse> uses = sorted_edge_uses(mesh.faces);
    const Neighbours neighbours = find_neighbours(mesh, uses);
    const Parts parts = agree_within_parts(neighbours, turn, repair.contrary_edges);
    std::vector<double> volumes;
    for (std::uint32_t part = 0; part < parts.count(); ++part)
        volumes.push_back(part_volume(mesh, parts.of(part), neighbours, turn));
    const std::vector<Role> roles = Nesting(mesh, parts, volumes, turn, repair).decide();
    repair.is_enclosed.assign(mesh.faces.size(), false);
    for (std::uint32_t part = 0; part < parts.count(); ++part) {
        const Role& role = roles[part];
        const bool is_wrong = role.is_inward ? volumes[part] > 0.0 : volumes[part] < 0.0;
        for (const std::uint32_t f : parts.of(part)) {
            repair.is_enclosed[f] = role.is_enclosed;
            if (turn[f] == is_wrong || role.is_enclosed) continue;
            std::swap(mesh.faces[f][1], mesh.faces[f][2]);
            if (!mesh.look.corner_uvs.empty())
                std::swap(mesh.look.corner_uvs[f][1], mesh.look.corner_uvs[f][2]);
            ++repair.flipped_faces;
        }
    }
    return repair;
}

}  // namespace gelatin
