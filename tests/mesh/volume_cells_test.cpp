#include "mesh/volume_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

#include "mesh/tet_repair.h"
#include "mesh/topology.h"
#include "mesh_samples.h"

namespace gelatin {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

double least_volume(const TetMesh& mesh) {
    double least = 1e300;
    for (const glm::uvec4& tet : mesh.tets) least = std::min(least, tet_volume(mesh, tet));
    return least;
}

// The corners of a prism of height 1 over a regular polygon, or of a pyramid.
std::vector<glm::dvec3> regular_cell(int n, bool is_pyramid) {
    std::vector<glm::dvec3> corners;
    for (int k = 0; k < (is_pyramid ? n : 2 * n); ++k) {
        const double angle = 2.0 * std::numbers::pi * (k % n) / n;
        corners.emplace_back(std::cos(angle), std::sin(angle), k / n);
    }
    if (is_pyramid) corners.emplace_back(0.0, 0.0, 1.0);
    return corners;
}

double base_area(int n) {
    return 0.5 * n * std::sin(2.0 * std::numbers::pi / n);
}

/// Divides one cell, whose corners are these points in this order.
struct OneCell {
    Notes notes;
    TetMesh mesh;

    OneCell(CellShape shape, std::vector<glm::dvec3> points, std::vector<std::uint32_t> corners = {}) {
        if (corners.empty()) {
            corners.resize(points.size());
            std::iota(corners.begin(), corners.end(), 0u);
        }
        VolumeCells cells;
        cells.positions = std::move(points);
        cells.add(shape, corners, false, 5);
        mesh = cells.divide("file", notes);
    }
};

TEST(VolumeCells, DividesEachShapeForAnyOrderOfIndices) {
    struct Case {
        CellShape shape;
        int n;
        bool is_pyramid;
    };
    std::mt19937 random(3);
    for (const Case& each :
         {Case{CellShape::pyramid, 4, true}, Case{CellShape::wedge, 3, false},
          Case{CellShape::hexahedron, 4, false}, Case{CellShape::pentagonal_prism, 5, false},
          Case{CellShape::hexagonal_prism, 6, false}}) {
        const std::vector<glm::dvec3> ideal = regular_cell(each.n, each.is_pyramid);
        ASSERT_EQ(ideal.size(), corner_count(each.shape));
        for (int trial = 0; trial < 200; ++trial) {
            std::vector<std::uint32_t> corners(ideal.size());
            std::iota(corners.begin(), corners.end(), 0u);
            std::shuffle(corners.begin(), corners.end(), random);
            std::vector<glm::dvec3> points(ideal.size());
            for (std::size_t k = 0; k < ideal.size(); ++k) points[corners[k]] = ideal[k];
            const OneCell cell(each.shape, points, corners);
            EXPECT_NEAR(total_volume(cell.mesh), base_area(each.n) / (each.is_pyramid ? 3.0 : 1.0), 1e-12);
            EXPECT_GT(least_volume(cell.mesh), 0.01);
            EXPECT_EQ(cell.mesh.positions, points);  // corners are enough
            EXPECT_EQ(cell.mesh.attributes, std::vector<int>(cell.mesh.tets.size(), 5));
            EXPECT_EQ(cell.notes.size(), 1u);
        }
    }
}

// ---- meshes of many cells

struct Grid {
    VolumeCells cells;
    std::vector<std::set<std::uint32_t>> nodes_of_cell;  // by attribute
};

/// A box of random columns of cells: hexahedra, wedges, pyramids or tets. Wedges have triangles on top and
/// bottom, so that only wedges fit there. Its nodes are numbered at random and
/// moved off their places, but not off the box's sides.
class RandomGrid {
public:
    explicit RandomGrid(unsigned seed) : random_(seed) {
        order_.resize(64);
        std::iota(order_.begin(), order_.end(), 0u);
        std::shuffle(order_.begin(), order_.end(), random_);
        grid_.cells.positions.resize(64);
        for (int n = 0; n < 64; ++n) {
            glm::dvec3 p(n % 4, n / 4 % 4, n / 16);
            for (int axis = 0; axis < 3; ++axis)
                if (p[axis] > 0.0 && p[axis] < 3.0) p[axis] += draw(-0.2, 0.2);
            grid_.cells.positions[order_[static_cast<std::size_t>(n)]] = p;
        }
    }

    Grid make() {
        for (int column = 0; column < 9; ++column) {
            const auto kind = static_cast<int>(draw(0.0, 4.0));
            for (int z = 0; z < 3; ++z) add_cell(column % 3, column / 3, z, kind);
        }
        return std::move(grid_);
    }

private:
    double draw(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }

    void add(CellShape shape, const std::vector<std::uint32_t>& corners) {
        grid_.cells.add(shape, corners, false, static_cast<int>(grid_.nodes_of_cell.size()));
        grid_.nodes_of_cell.emplace_back(corners.begin(), corners.end());
    }

    void add_cell(int x, int y, int z, int kind) {
        std::array<std::uint32_t, 8> c;
        constexpr std::array<int, 8> kPlaces = {0, 1, 3, 2, 4, 5, 7, 6};
        for (std::size_t k = 0; k < 8; ++k) {
            const int place = kPlaces[k];
            c[k] = order_[static_cast<std::size_t>(x + (place & 1) + 4 * (y + (place >> 1 & 1)) +
                                                   16 * (z + (place >> 2)))];
        }
        if (kind == 0) return add(CellShape::hexahedron, {c.begin(), c.end()});
        if (kind == 1) {
            add(CellShape::wedge, {c[0], c[1], c[2], c[4], c[5], c[6]});
            return add(CellShape::wedge, {c[0], c[2], c[3], c[4], c[6], c[7]});
        }
        glm::dvec3 middle(0.0);
        for (const std::uint32_t node : c) middle += grid_.cells.positions[node] / 8.0;
        const auto centre = static_cast<std::uint32_t>(grid_.cells.positions.size());
        grid_.cells.positions.push_back(middle);
        constexpr std::array<std::array<std::size_t, 4>, 6> kSides = {
            {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}};
        for (const auto& s : kSides) {
            std::array<std::uint32_t, 4> q = {c[s[0]], c[s[1]], c[s[2]], c[s[3]]};
            if (kind == 2) {
                add(CellShape::pyramid, {q[0], q[1], q[2], q[3], centre});
                continue;
            }
            // Tets of the file have any diagonal, but both sides the same.
            const std::uint32_t highest = *std::max_element(q.begin(), q.end());
            std::rotate(q.begin(), std::find(q.begin(), q.end(), highest), q.end());
            if ((highest + q[2]) % 3 == 0) std::rotate(q.begin(), q.begin() + 1, q.end());
            add(CellShape::tet, {q[0], q[1], q[2], centre});
            add(CellShape::tet, {q[0], q[2], q[3], centre});
        }
    }

    std::mt19937 random_;
    std::vector<std::uint32_t> order_;
    Grid grid_;
};

// Sides between cells that did not fit would be boundary faces inside the box.
void expect_fills_the_box(const TetMesh& mesh) {
    EXPECT_NEAR(total_volume(mesh), 27.0, 1e-11);
    double area = 0.0;
    for (const glm::uvec3& face : mesh.faces) {
        const glm::dvec3 &a = mesh.positions[face[0]], &b = mesh.positions[face[1]],
                         &c = mesh.positions[face[2]];
        bool is_on_side = false;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {0.0, 3.0})
                is_on_side = is_on_side || (a[axis] == side && b[axis] == side && c[axis] == side);
        }
        EXPECT_TRUE(is_on_side);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_NEAR(area, 54.0, 1e-11);
}

TEST(VolumeCells, TetsOfNeighboursFitTogether) {
    std::size_t centred = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        Grid grid = RandomGrid(seed).make();
        Notes notes;
        TetMesh mesh = grid.cells.divide("grid", notes);
        ASSERT_GT(least_volume(mesh), 0.0);
        for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
            const std::set<std::uint32_t>& nodes =
                grid.nodes_of_cell.at(static_cast<std::size_t>(mesh.attributes[t]));
            int others = 0;
            for (int k = 0; k < 4; ++k) others += nodes.count(mesh.tets[t][k]) == 0 ? 1 : 0;
            EXPECT_LE(others, 1);  // a node at the centre
        }
        centred += static_cast<std::size_t>(std::count_if(notes.begin(), notes.end(), [](const Note& note) {
            return note.text.find("a node at their centre") != std::string::npos;
        }));
        repair_tets(mesh, "grid", notes);
        for (const Note& note : notes) {
            EXPECT_THAT(note.text, testing::Not(HasSubstr("overlap")));
            EXPECT_THAT(note.text, testing::Not(HasSubstr("more than two")));
        }
        expect_fills_the_box(mesh);
    }
    EXPECT_GT(centred, 20u);  // where the file's tets have another diagonal
}

// ---- cells that are not as they should be

const std::vector<glm::dvec3> kCube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

TEST(VolumeCells, TakesCellsWithCornersThatCoincide) {
    const auto expect_volume = [](const std::vector<std::uint32_t>& corners, double volume,
                                  std::size_t tets) {
        const OneCell by_index(CellShape::hexahedron, kCube, corners);
        EXPECT_NEAR(total_volume(by_index.mesh), volume, 1e-15);
        EXPECT_EQ(by_index.mesh.tets.size(), tets);
        EXPECT_GT(least_volume(by_index.mesh), 0.0);
        std::vector<glm::dvec3> points;
        for (const std::uint32_t corner : corners) points.push_back(kCube[corner]);
        const OneCell by_place(CellShape::hexahedron, points);
        EXPECT_NEAR(total_volume(by_place.mesh), volume, 1e-15);
        EXPECT_EQ(by_place.mesh.tets.size(), tets);
    };
    expect_volume({0, 1, 2, 2, 4, 5, 6, 6}, 0.5, 3);        // a wedge
    expect_volume({0, 1, 2, 3, 4, 4, 4, 4}, 1.0 / 3.0, 2);  // a pyramid
    expect_volume({0, 1, 3, 3, 4, 4, 4, 4}, 1.0 / 6.0, 1);  // a tet
}

TEST(VolumeCells, DiscardsCellsThatCollapse) {
    for (const std::vector<std::uint32_t>& corners :
         {std::vector<std::uint32_t>{0, 1, 2, 3, 0, 1, 2, 3}, std::vector<std::uint32_t>(8, 4)}) {
        const OneCell cell(CellShape::hexahedron, kCube, corners);
        EXPECT_THAT(cell.mesh.tets, IsEmpty());
        EXPECT_THAT(cell.notes, ElementsAre("discarded cells without volume: 1"));
    }
}

TEST(VolumeCells, FlipsInvertedCells) {
    const OneCell cell(CellShape::hexahedron, kCube, {4, 5, 6, 7, 0, 1, 2, 3});
    EXPECT_DOUBLE_EQ(total_volume(cell.mesh), 1.0);
    EXPECT_GT(least_volume(cell.mesh), 0.0);
    EXPECT_THAT(cell.notes, Contains("flipped inverted cells: 1"));
}

// Corner 1 is pushed in so far that corner 0 does not see all sides any more.
TEST(VolumeCells, ConnectsAnotherCornerWhereThatIsBetter) {
    std::vector<glm::dvec3> points = kCube;
    points[1] = {0.5, 0.45, 0.52};
    const OneCell cell(CellShape::hexahedron, points);
    EXPECT_GT(least_volume(cell.mesh), 0.0);
    EXPECT_EQ(cell.mesh.positions.size(), 8u);
    EXPECT_THAT(cell.notes, ElementsAre("divided into tets: hexahedra: 1"));
}

TEST(VolumeCells, GivesCellsACentreWhereCornersAreNotEnough) {
    const OneCell cell(CellShape::hexahedron, {{0.1, 0.4, -0.4},
                                               {1.1, 0.0, -0.4},
                                               {1.4, 1.3, 0.0},
                                               {0.0, 0.6, 0.1},
                                               {0.1, 0.0, 1.1},
                                               {1.1, 0.2, 0.8},
                                               {0.9, 1.4, 1.2},
                                               {-0.4, 0.6, 1.4}});
    EXPECT_GT(least_volume(cell.mesh), 0.0);
    EXPECT_EQ(cell.mesh.positions.size(), 9u);
    EXPECT_EQ(cell.mesh.tets.size(), 12u);
    EXPECT_THAT(cell.notes,
                Contains("cells divided with a node at their centre, as their corners give no good tets: 1"));
}

TEST(VolumeCells, RefusesFlatCells) {
    std::vector<glm::dvec3> points = kCube;
    for (glm::dvec3& p : points) p = {p.x + 0.5 * p.z, p.y + 0.25 * p.z, 0.0};
    EXPECT_THAT(refusal([&] { OneCell(CellShape::hexahedron, points); }),
                HasSubstr("file: cell 1: cannot be divided into tets that have a volume"));
}

TEST(VolumeCells, WarnsOfCellsThatOverlapThemselves) {
    std::vector<glm::dvec3> points = kCube;
    points[6] = {-0.5, -0.4, -0.3};  // through the opposite corner
    const OneCell cell(CellShape::hexahedron, points);
    EXPECT_THAT(cell.notes, Contains(testing::Field(&Note::is_warning, true)));
    EXPECT_THAT(cell.notes.back().text, HasSubstr("cells that overlap themselves"));
}

}  // namespace
}  // namespace gelatin
