#include "mesh/lattice/lost_parts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "core/disjoint_sets.h"
#include "mesh/lattice/separate_touching.h"
#include "mesh/topology.h"

namespace gelatin::lattice {
namespace {

double area_of(const Triangle& face) {
    return 0.5 * glm::length(glm::cross(face[1] - face[0], face[2] - face[0]));
}

// The thickness below which the thinnest tenth of the places lie, by area.
double thin_end(std::vector<ThinPlace> places) {
    std::sort(places.begin(), places.end(),
              [](const ThinPlace& a, const ThinPlace& b) { return a.thickness < b.thickness; });
    double area = 0.0, sum = 0.0;
    for (const ThinPlace& place : places) area += area_of(place.face);
    for (const ThinPlace& place : places) {
        sum += area_of(place.face);
        if (sum >= 0.1 * area) return place.thickness;
    }
    return places.back().thickness;
}

/// Which tets are joined by faces, and which of these sets is at a place.
class TetSets {
public:
    explicit TetSets(const TetMesh& mesh) : sets_(mesh.tets.size()), boundary_({mesh.positions, mesh.faces}) {
        for (const InnerFace& face : inner_faces(mesh.tets)) sets_.unite(face.tets[0], face.tets[1]);
        std::map<std::array<std::uint32_t, 3>, std::uint32_t> tet_of_face;
        const auto key = [](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            std::array<std::uint32_t, 3> nodes = {a, b, c};
            std::sort(nodes.begin(), nodes.end());
            return nodes;
        };
        for (const glm::uvec3& f : mesh.faces) tet_of_face[key(f[0], f[1], f[2])] = 0;
        for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
            const glm::uvec4& tet = mesh.tets[t];
            if (sets_.least(t) == t) ++count_;
            for (int k = 0; k < 4; ++k) {
                const auto found = tet_of_face.find(key(tet[k], tet[(k + 1) % 4], tet[(k + 2) % 4]));
                if (found != tet_of_face.end()) found->second = t;
            }
        }
        for (const std::uint32_t source : boundary_.sources()) {
            const glm::uvec3& f = mesh.faces[source];
            set_of_face_.push_back(sets_.least(tet_of_face[key(f[0], f[1], f[2])]));
        }
    }

    std::uint32_t of_tet(std::uint32_t tet) { return sets_.least(tet); }
    std::size_t count() const { return count_; }
    std::optional<std::uint32_t> find_near(const glm::dvec3& p, double radius) const {
        const auto nearest = boundary_.find_nearest(p, radius);
        return nearest ? std::optional(set_of_face_[nearest->face]) : std::nullopt;
    }

private:
    DisjointSets sets_;
    FaceTree boundary_;
    std::vector<std::uint32_t> set_of_face_;
    std::size_t count_ = 0;
};

}  // namespace

LostParts find_lost_parts(const EnclosedSpace& space, ThinParts& thin, const CellSizes& sizes,
                          const TetMesh& mesh) {
    const double smallest = smallest_cell(sizes);
    const EnclosedSpace filled({mesh.positions, mesh.faces});
    const std::vector<ThinPlace> places = thin.find(sizes.boundary / kCellsInThickness, sizes.boundary);
    std::vector<std::uint8_t> is_lost(places.size(), 0);
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t p) {
        const glm::dvec3 middle = places[p].middle();
        is_lost[p] = !filled.tree().find_nearest(middle, smallest) && !filled.contains(middle) &&
                     space.contains(middle);
    });
    LostParts lost;
    std::vector<ThinPlace> gone;
    std::map<std::uint32_t, bool> is_piece_lost;  // of small ones, as a whole
    double lost_area = 0.0, thickest = 0.0;
    for (const Triangle& face : space.tree().faces()) lost.area += area_of(face);
    for (std::size_t p = 0; p < places.size(); ++p) {
        if (places[p].is_small_piece) {
            const auto [known, is_first] = is_piece_lost.emplace(places[p].piece, is_lost[p] != 0);
            if (!is_first) known->second = known->second && is_lost[p] != 0;
        }
        if (is_lost[p] == 0) continue;
        gone.push_back(places[p]);
        lost_area += area_of(places[p].face);
        if (places[p].thickness <= thickest) continue;
        thickest = places[p].thickness;
        lost.where = places[p].middle();
    }
    for (const auto& [piece, is_whole] : is_piece_lost) lost.pieces += is_whole ? 1 : 0;
    if (gone.empty()) return lost;
    lost.area_fraction = lost_area / lost.area;
    const double fits = std::ldexp(kCellsInThickness * thin_end(std::move(gone)), sizes.finer_levels);
    lost.cell_size = std::min(fits, 0.5 * sizes.boundary);
    return lost;
}

Fragments remove_fragments(const EnclosedSpace& space, double radius, TetMesh& mesh) {
    constexpr double kLeast = 0.02;  // of the area of a piece
    TetSets sets(mesh);
    Fragments fragments;
    if (sets.count() < 2) return fragments;
    std::map<std::uint32_t, std::map<std::uint32_t, double>> areas;  // by piece and set
    for (std::uint32_t f = 0; f < space.tree().faces().size(); ++f) {
        const Triangle& face = space.tree().faces()[f];
        const auto set = sets.find_near((face[0] + face[1] + face[2]) / 3.0, radius);
        if (set) areas[space.piece_of(f)][*set] += area_of(face);
    }
    std::map<std::uint32_t, bool> is_kept;  // if one piece needs it
    for (const auto& [piece, of_piece] : areas) {
        double whole = 0.0;
        std::size_t kept = 0;
        for (const auto& [set, area] : of_piece) whole += area;
        for (const auto& [set, area] : of_piece) {
            const bool keeps = area >= kLeast * whole;
            is_kept[set] = is_kept[set] || keeps;
            kept += keeps ? 1 : 0;
        }
        if (kept > 1) ++fragments.divided;
    }
    std::vector<bool> keep(mesh.tets.size(), true);
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
        const auto found = is_kept.find(sets.of_tet(t));
        if (found != is_kept.end()) keep[t] = found->second;
    }
    for (const auto& [set, kept] : is_kept) fragments.removed += kept ? 0 : 1;
    if (keep_tets(mesh, keep) > 0) {
        remove_unused_nodes(mesh);
        mesh.faces = boundary_faces(mesh.tets);
    }
    return fragments;
}

}  // namespace gelatin::lattice
