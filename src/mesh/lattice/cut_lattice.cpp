#include "mesh/lattice/cut_lattice.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "mesh/lattice/cut_tet.h"

namespace gelatin::lattice {
namespace {

// Closer to the boundary than these fractions of an edge a point moves there; of edges along an axis and of
// the diagonal ones. Table 1 of the paper, for the least angles between faces.
constexpr double kAlphaLong = 0.24999, kAlphaShort = 0.41189;

using Edge = std::array<std::uint32_t, 2>;

// An edge with one end inside.
struct CutEdge {
    Edge points;  // ascending
    glm::dvec3 at = {};
};

// A point that could move to a cut.
struct Move {
    double closeness;  // the distance, relative to the longest allowed
    std::uint32_t point, edge;
};

// The tets around each point that may move.
class PointTets {
public:
    PointTets(const std::vector<std::array<std::uint32_t, 4>>& tets, const std::vector<Move>& moves,
              std::size_t point_count) {
        std::vector<bool> may_move(point_count, false);
        for (const Move& move : moves) may_move[move.point] = true;
        for (std::uint32_t t = 0; t < tets.size(); ++t) {
            for (const std::uint32_t point : tets[t]) {
                if (may_move[point]) pairs_.push_back({point, t});
            }
        }
        tbb::parallel_sort(pairs_);
    }
    std::span<const std::pair<std::uint32_t, std::uint32_t>> of(std::uint32_t point) const {
        const auto by_point = [](const auto& pair, std::uint32_t p) { return pair.first < p; };
        return {std::lower_bound(pairs_.begin(), pairs_.end(), point, by_point),
                std::lower_bound(pairs_.begin(), pairs_.end(), point + 1, by_point)};
    }

private:
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;  // point, tet
};

class LatticeCutter {
public:
    LatticeCutter(const Lattice& lattice, const EnclosedSpace& space) : lattice_(lattice), space_(space) {
        const std::size_t count = lattice.tets.points.size();
        for (std::uint32_t p = 0; p < count; ++p) {
            mesh_.positions.push_back(lattice.position(p));
            side_.push_back(lattice.inside[p] != 0 ? Side::inside : Side::outside);
        }
    }

    TetMesh cut() {
        find_cut_edges();
        move_points();
        for (const CutEdge& edge : edges_) mesh_.positions.push_back(edge.at);
        for (const auto& tet : lattice_.tets.tets) add_tet(tet);
        orient_tets();
        return std::move(mesh_);
    }

private:
    bool is_cut(const Edge& e) const {
        return side_[e[0]] != side_[e[1]] && side_[e[0]] != Side::boundary && side_[e[1]] != Side::boundary;
    }

    template <class Visit>
    void for_each_edge(const Visit& visit) const {
        for (const auto& tet : lattice_.tets.tets) {
            for (int i = 0; i < 3; ++i) {
                for (int j = i + 1; j < 4; ++j)
                    visit(Edge{std::min(tet[i], tet[j]), std::max(tet[i], tet[j])});
            }
        }
    }

    void find_cut_edges() {
        for_each_edge([&](const Edge& e) {
            if (is_cut(e)) edges_.push_back({e});
        });
        const auto by_points = [](const CutEdge& a, const CutEdge& b) { return a.points < b.points; };
        const auto same = [](const CutEdge& a, const CutEdge& b) { return a.points == b.points; };
        tbb::parallel_sort(edges_.begin(), edges_.end(), by_points);
        edges_.erase(std::unique(edges_.begin(), edges_.end(), same), edges_.end());
        tbb::parallel_for(std::size_t{0}, edges_.size(), [&](std::size_t e) {
            auto [a, b] = edges_[e].points;
            if (side_[a] != Side::inside) std::swap(a, b);
            edges_[e].at = space_.find_boundary(mesh_.positions[a], mesh_.positions[b]);
        });
    }

    // The length of each point's shortest edge: at most that far its tets let it move.
    std::vector<double> shortest_edges() const {
        std::vector<double> shortest(mesh_.positions.size(), std::numeric_limits<double>::infinity());
        for_each_edge([&](const Edge& e) {
            const double length = glm::distance(mesh_.positions[e[0]], mesh_.positions[e[1]]);
            for (const std::uint32_t p : e) shortest[p] = std::min(shortest[p], length);
        });
        return shortest;
    }

    // Moves points that are close to a cut to it, the closest first. Edges between a moved point and another
    // are cut no more.
    void move_points() {
        std::vector<Move> moves;
        const std::vector<double> shortest = shortest_edges();
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            const auto& [a, b] = edges_[e].points;
            const glm::dvec3 d = mesh_.positions[b] - mesh_.positions[a];
            const double length = glm::length(d);
            const bool is_long = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > 0.999 * length;
            for (const std::uint32_t point : edges_[e].points) {
                const double reach =
                    std::min((is_long ? kAlphaLong : kAlphaShort) * length, kAlphaShort * shortest[point]);
                const double closeness = glm::distance(mesh_.positions[point], edges_[e].at) / reach;
                if (closeness < 1.0) moves.push_back({closeness, point, e});
            }
        }
        std::sort(moves.begin(), moves.end(), [](const Move& x, const Move& y) {
            return std::tie(x.closeness, x.point, x.edge) < std::tie(y.closeness, y.point, y.edge);
        });
        const PointTets around(lattice_.tets.tets, moves, mesh_.positions.size());
        for (const Move& move : moves) {
            if (!is_cut(edges_[move.edge].points)) continue;
            glm::dvec3& position = mesh_.positions[move.point];
            const glm::dvec3 old = position;
            position = edges_[move.edge].at;
            if (keeps_volumes(around.of(move.point)))
                side_[move.point] = Side::boundary;
            else
                position = old;
        }
        std::erase_if(edges_, [&](const CutEdge& edge) { return !is_cut(edge.points); });
    }

    // Points may move as long as no tet of the lattice becomes flat or inverted.
    bool keeps_volumes(std::span<const std::pair<std::uint32_t, std::uint32_t>> tets) const {
        constexpr double kLeast = 0.05;  // of the volume in the lattice
        return std::all_of(tets.begin(), tets.end(), [&](const auto& pair) {
            const auto& [a, b, c, d] = lattice_.tets.tets[pair.second];
            const auto volume = [](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r,
                                   const glm::dvec3& s) { return glm::dot(glm::cross(q - p, r - p), s - p); };
            const auto& at = mesh_.positions;
            const double before = volume(lattice_.position(a), lattice_.position(b), lattice_.position(c),
                                         lattice_.position(d));
            return volume(at[a], at[b], at[c], at[d]) / before > kLeast;
        });
    }

    std::uint32_t node_of_cut(std::uint32_t a, std::uint32_t b) const {
        const Edge key = {std::min(a, b), std::max(a, b)};
        const auto found =
            std::lower_bound(edges_.begin(), edges_.end(), key,
                             [](const CutEdge& edge, const Edge& k) { return edge.points < k; });
        return static_cast<std::uint32_t>(lattice_.tets.points.size() + (found - edges_.begin()));
    }

    void add_tet(const std::array<std::uint32_t, 4>& tet) {
        std::array<Side, 4> sides = {};
        for (int k = 0; k < 4; ++k) sides[k] = side_[tet[k]];
        const auto count = [&](Side side) { return std::count(sides.begin(), sides.end(), side); };
        if (count(Side::boundary) == 4) {  // between two moved sides of a thin part, or outside
            glm::dvec3 center(0.0);
            for (const std::uint32_t point : tet) center += 0.25 * mesh_.positions[point];
            if (space_.contains(center)) mesh_.tets.emplace_back(tet[0], tet[1], tet[2], tet[3]);
            return;
        }
        if (count(Side::inside) == 0) return;
        const auto cut = [&](std::uint32_t a, std::uint32_t b) { return node_of_cut(a, b); };
        cut_tet(tet, sides, cut, mesh_.positions, mesh_.tets);
    }

    void orient_tets() {
        for (glm::uvec4& tet : mesh_.tets) {
            const glm::dvec3 &a = mesh_.positions[tet[0]], &b = mesh_.positions[tet[1]],
                             &c = mesh_.positions[tet[2]], &d = mesh_.positions[tet[3]];
            if (glm::dot(glm::cross(b - a, c - a), d - a) < 0.0) std::swap(tet[2], tet[3]);
        }
    }

    const Lattice& lattice_;
    const EnclosedSpace& space_;
    std::vector<Side> side_;  // shape [points]
    std::vector<CutEdge> edges_;
    TetMesh mesh_;
};

}  // namespace

TetMesh cut_lattice(const Lattice& lattice, const EnclosedSpace& space) {
    return LatticeCutter(lattice, space).cut();
}

}  // namespace gelatin::lattice
