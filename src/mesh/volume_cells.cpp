#include "mesh/volume_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "gelatin/error.h"
#include "mesh/flat_tets.h"
#include "mesh/merge_points.h"
#include "mesh/tet_check.h"
#include "mesh/tet_repair.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

/// A side of a cell: corners, counter-clockwise from outside.
using Side = std::vector<std::uint32_t>;

std::vector<Side> pyramid_sides(std::uint32_t n) {
    std::vector<Side> sides(1);
    for (std::uint32_t k = 0; k < n; ++k) {
        sides[0].insert(sides[0].begin(), k);
        sides.push_back({k, (k + 1) % n, n});
    }
    return sides;
}

std::vector<Side> prism_sides(std::uint32_t n) {
    std::vector<Side> sides(2);
    for (std::uint32_t k = 0; k < n; ++k) {
        sides[0].insert(sides[0].begin(), k);
        sides[1].push_back(n + k);
        sides.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
    }
    return sides;
}

struct ShapeFacts {
    const char* plural;
    std::size_t corners;
    std::vector<Side> sides;
};

const ShapeFacts& facts_of(CellShape shape) {
    static const std::array<ShapeFacts, 8> all_facts = {{{"", 0, {}},
                                                         {"", 0, {}},
                                                         {"tets", 4, pyramid_sides(3)},
                                                         {"pyramids", 5, pyramid_sides(4)},
                                                         {"wedges", 6, prism_sides(3)},
                                                         {"hexahedra", 8, prism_sides(4)},
                                                         {"pentagonal prisms", 10, prism_sides(5)},
                                                         {"hexagonal prisms", 12, prism_sides(6)}}};
    return all_facts.at(static_cast<std::size_t>(shape));
}

}  // namespace

std::size_t corner_count(CellShape shape) {
    return facts_of(shape).corners;
}

const char* plural_of(CellShape shape) {
    return facts_of(shape).plural;
}

/// Divides all cells but tets.
class CellDivision {
public:
    CellDivision(VolumeCells& cells, TetMesh& mesh, const std::string& file)
        : cells_(cells), mesh_(mesh), file_(file) {
        rank_ = merge_points(mesh.positions, kCoincidentNodes).into;
        find_given_triangles();
    }

    void divide_all(Notes& notes) {
        for (const VolumeCells::Cell& cell : cells_.cells_) divide(cell);
        report(notes);
    }

private:
    using Cell = VolumeCells::Cell;
    using Triangle = std::array<std::uint32_t, 3>;

    std::uint32_t corner(const Cell& cell, std::uint32_t k) const { return cells_.corners_[cell.first + k]; }
    const glm::dvec3& at(std::uint32_t node) const { return mesh_.positions[node]; }

    Triangle key_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        Triangle key = {rank_[a], rank_[b], rank_[c]};
        std::sort(key.begin(), key.end());
        return key;
    }

    // The sides of the file's tets between nodes of other cells.
    void find_given_triangles() {
        std::vector<bool> is_shared(rank_.size(), false);
        for (const std::uint32_t node : cells_.corners_) is_shared[rank_[node]] = true;
        for (const glm::uvec4& tet : mesh_.tets) {
            for (int left_out = 0; left_out < 4; ++left_out) {
                const std::uint32_t a = tet[(left_out + 1) % 4], b = tet[(left_out + 2) % 4],
                                    c = tet[(left_out + 3) % 4];
                if (is_shared[rank_[a]] && is_shared[rank_[b]] && is_shared[rank_[c]])
                    given_.push_back(key_of(a, b, c));
            }
        }
        std::sort(given_.begin(), given_.end());
    }

    bool is_given(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return std::binary_search(given_.begin(), given_.end(), key_of(a, b, c));
    }

    // Nodes of a side, without those that coincide with their neighbour. Empty if no area is left.
    Side nodes_of(const Cell& cell, const Side& corners) const {
        Side nodes;
        for (const std::uint32_t k : corners) {
            const std::uint32_t node = corner(cell, k);
            if (nodes.empty() || rank_[nodes.back()] != rank_[node]) nodes.push_back(node);
        }
        while (nodes.size() > 1 && rank_[nodes.front()] == rank_[nodes.back()]) nodes.pop_back();
        Side ranks = nodes;
        for (std::uint32_t& node : ranks) node = rank_[node];
        std::sort(ranks.begin(), ranks.end());
        const bool is_folded = std::adjacent_find(ranks.begin(), ranks.end()) != ranks.end();
        if (nodes.size() < 3 || is_folded) nodes.clear();
        return nodes;
    }

    // Cuts a side, from its node of lowest rank, or as tets of the file do.
    void append_triangles(Side nodes) {
        if (nodes.empty()) return;
        const auto lowest =
            std::min_element(nodes.begin(), nodes.end(), [&](auto a, auto b) { return rank_[a] < rank_[b]; });
        std::rotate(nodes.begin(), lowest, nodes.end());
        const bool is_other_diagonal = nodes.size() == 4 && is_given(nodes[0], nodes[1], nodes[3]) &&
                                       is_given(nodes[1], nodes[2], nodes[3]);
        if (is_other_diagonal) std::rotate(nodes.begin(), nodes.begin() + 1, nodes.end());
        for (std::size_t k = 2; k < nodes.size(); ++k)
            triangles_.push_back({nodes[0], nodes[k - 1], nodes[k]});
    }

    // Tets between a point and all triangles that do not contain it.
    std::vector<glm::uvec4> connect(std::uint32_t node) const {
        std::vector<glm::uvec4> tets;
        for (const auto& [a, b, c] : triangles_) {
            if (rank_[a] == rank_[node] || rank_[b] == rank_[node] || rank_[c] == rank_[node]) continue;
            tets.emplace_back(node, a, b, c);
        }
        return tets;
    }

    double volume_of(const std::vector<glm::uvec4>& tets) const {
        double volume = 0.0;
        for (const glm::uvec4& tet : tets) volume += tet_volume(mesh_, tet);
        return volume;
    }

    // Of the worst tet; negative if it is inverted.
    double least_roundness(const std::vector<glm::uvec4>& tets) const {
        double least = std::numeric_limits<double>::infinity();
        for (const glm::uvec4& tet : tets) {
            const double round = roundness({at(tet[0]), at(tet[1]), at(tet[2]), at(tet[3])});
            least = std::min(least, tet_volume(mesh_, tet) < 0.0 ? -round : round);
        }
        return least;
    }

    void add_centre() {
        glm::dvec3 sum(0.0);
        double weight = 0.0;
        for (const auto& [a, b, c] : triangles_) {
            const double area = glm::length(glm::cross(at(b) - at(a), at(c) - at(a)));
            sum += area * (at(a) + at(b) + at(c)) / 3.0;
            weight += area;
        }
        rank_.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
        mesh_.positions.push_back(weight > 0.0 ? sum / weight : at(triangles_[0][0]));
    }

    void divide(const Cell& cell) {
        triangles_.clear();
        for (const Side& side : facts_of(cell.shape).sides) append_triangles(nodes_of(cell, side));
        if (triangles_.empty()) {
            ++collapsed_;
            return;
        }
        std::uint32_t lowest = triangles_[0][0];
        for (const Triangle& triangle : triangles_) {
            for (const std::uint32_t node : triangle) lowest = rank_[node] < rank_[lowest] ? node : lowest;
        }
        std::vector<glm::uvec4> tets = connect(lowest);
        if (tets.empty()) {  // two sides on top of each other
            ++collapsed_;
            return;
        }
        if (volume_of(tets) < 0.0) {
            for (Triangle& triangle : triangles_) std::swap(triangle[1], triangle[2]);
            tets = connect(lowest);
            // Programs do not agree on the order of a wedge's corners.
            inverted_ += cell.shape != CellShape::wedge ? 1 : 0;
        }
        double least = least_roundness(tets);
        if (is_poor(least)) {
            for (const Triangle& triangle : triangles_) {
                for (const std::uint32_t node : triangle) take_if_better(connect(node), tets, least);
            }
        }
        if (is_poor(least)) try_with_centre(tets, least);
        const auto flat = std::find_if(tets.begin(), tets.end(),
                                       [&](const glm::uvec4& tet) { return is_flat(mesh_, tet); });
        if (flat != tets.end()) refuse(cell);
        if (least < 0.0 && tangled_++ == 0) first_tangled_ = cell.number;
        mesh_.tets.insert(mesh_.tets.end(), tets.begin(), tets.end());
        mesh_.attributes.insert(mesh_.attributes.end(), tets.size(), cell.attribute);
        ++divided_[cell.shape];
    }

    static bool is_poor(double roundness) { return roundness < 1e-3; }

    // Cells that are flat as a whole gain little.
    bool take_if_better(std::vector<glm::uvec4> others, std::vector<glm::uvec4>& tets, double& least) const {
        const double least_of_others = least_roundness(others);
        if (others.empty() || !(least_of_others > std::max(least, 2.0 * least))) return false;
        tets = std::move(others);
        least = least_of_others;
        return true;
    }

    void try_with_centre(std::vector<glm::uvec4>& tets, double& least) {
        add_centre();
        if (take_if_better(connect(rank_.back()), tets, least)) {
            ++centred_;
        } else {
            mesh_.positions.pop_back();
            rank_.pop_back();
        }
    }

    [[noreturn]] void refuse(const Cell& cell) const {
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t k = 0; k < corner_count(cell.shape); ++k) numbers.push_back(corner(cell, k) + 1);
        throw InvalidInput(
            {file_,
             0,
             fmt::format("cell {}", cell.number),
             {},
             fmt::format("cannot be divided into tets that have a volume: it is flat, not convex, or its "
                         "corners, nodes {}, are in another order than those of {}",
                         fmt::join(numbers, " "), plural_of(cell.shape))});
    }

    void report(Notes& notes) const {
        const auto note = [&](std::size_t count, const char* text) {
            if (count > 0) notes.push_back(fmt::format(fmt::runtime(text), count));
        };
        std::vector<std::string> kinds;
        for (const auto& [shape, count] : divided_)
            kinds.push_back(fmt::format("{}: {}", plural_of(shape), count));
        if (!kinds.empty()) notes.push_back(fmt::format("divided into tets: {}", fmt::join(kinds, ", ")));
        note(centred_, "cells divided with a node at their centre, as their corners give no good tets: {}");
        note(collapsed_, "discarded cells without volume: {}");
        note(inverted_, "flipped inverted cells: {}");
        if (tangled_ > 0) {
            notes.push_back(
                warning(fmt::format("cells that overlap themselves, as they are far from convex or their "
                                    "corners are in another order: {} (the first is cell {})",
                                    tangled_, first_tangled_)));
        }
    }

    const VolumeCells& cells_;
    TetMesh& mesh_;
    const std::string& file_;
    std::vector<std::uint32_t> rank_;  ///< of each node: the first node at its place
    std::vector<Triangle> given_;      ///< ranks, ascending
    std::vector<Triangle> triangles_;  ///< of the current cell
    std::map<CellShape, std::size_t> divided_;
    std::size_t centred_ = 0, collapsed_ = 0, inverted_ = 0, tangled_ = 0, first_tangled_ = 0;
};

void VolumeCells::add(CellShape shape, std::span<const std::uint32_t> corners, bool is_curved,
                      int attribute) {
    ++count_;
    curved_ += is_curved ? 1 : 0;
    if (shape == CellShape::tet) {
        tets_.emplace_back(corners[0], corners[1], corners[2], corners[3]);
        tet_attributes_.push_back(attribute);
        return;
    }
    cells_.push_back({count_, corners_.size(), attribute, shape});
    corners_.insert(corners_.end(), corners.begin(), corners.end());
}

void VolumeCells::add_other(CellShape shape, const std::string& kind, std::size_t count) {
    count_ += count;
    (shape == CellShape::flat ? flat_ : unknown_[kind]) += count;
}

TetMesh VolumeCells::divide(const std::string& file, Notes& notes) {
    TetMesh mesh{std::move(positions), std::move(tets_), {}, std::move(tet_attributes_)};
    if (flat_ > 0) notes.push_back(fmt::format("ignored points, lines and surfaces: {}", flat_));
    for (const auto& [kind, count] : unknown_) {
        notes.push_back(warning(
            fmt::format("the body lacks cells of a kind that Gelatin cannot read, {}: {}", kind, count)));
    }
    if (curved_ > 0)
        notes.push_back(fmt::format("kept the corners only of cells with more nodes: {}", curved_));
    if (!cells_.empty()) CellDivision(*this, mesh, file).divide_all(notes);
    return mesh;
}

}  // namespace gelatin
