// Cells that are no tets, in every format that has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "cell_samples.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class CellFileTest : public TetFileTest {
protected:
    void expect_mixed(const std::string& name, const std::string& content) {
        SCOPED_TRACE(name);
        const TetMesh mesh = read(name, content);
        EXPECT_THAT(notes_, ElementsAre("divided into tets: pyramids: 1, wedges: 1, hexahedra: 1"));
        EXPECT_EQ(mesh.positions, kMixedNodes);
        EXPECT_EQ(mesh.tets.size(), 11u);
        EXPECT_EQ(mesh.faces.size(), 18u);  // so no side is between two cells
        EXPECT_DOUBLE_EQ(total_volume(mesh), kMixedVolume);
        std::map<int, double> volumes;
        for (std::size_t t = 0; t < mesh.tets.size(); ++t)
            volumes[mesh.attributes.at(t)] += tet_volume(mesh, mesh.tets[t]);
        EXPECT_EQ(volumes.size(), 3u);
        EXPECT_DOUBLE_EQ(volumes[7], 1.0);
        EXPECT_DOUBLE_EQ(volumes[8], 0.5);
        EXPECT_DOUBLE_EQ(volumes[9], 1.0 / 3.0);
    }
};

TEST_F(CellFileTest, DividesThemInEveryFormat) {
    expect_mixed("a.vtk", mixed_vtk());
    expect_mixed("a.vtu", mixed_vtu());
    expect_mixed("a.mesh", mixed_medit());
    expect_mixed("a.msh", mixed_gmsh2());
    expect_mixed("b.msh", mixed_gmsh4());
    for (const bool swapped : {false, true}) {
        expect_mixed("c.msh", mixed_gmsh2_binary(swapped));
        expect_mixed("d.msh", mixed_gmsh4_binary(swapped));
    }
}

// VTK's own wedge has the other orientation. Programs use both.
TEST_F(CellFileTest, TakesWedgesOfEitherOrientation) {
    expect_mixed("a.vtk", replaced(mixed_vtk(), "6 1 5 8 2 6 9", "6 1 8 5 2 9 6"));
}

TEST_F(CellFileTest, TakesVoxels) {
    const std::string rows = replaced(mixed_vtk(), "8 0 1 2 3 4 5 6 7", "8 0 1 3 2 4 5 7 6");
    expect_mixed("a.vtk", replaced(rows, "\n12 13 14", "\n11 13 14"));
}

TEST_F(CellFileTest, TakesTheCornersOfCurvedCells) {
    const auto expect_cube = [&](const std::string& name, const std::string& content) {
        SCOPED_TRACE(content);
        EXPECT_DOUBLE_EQ(total_volume(read(name, content)), 1.0);
        EXPECT_THAT(notes_, Contains("kept the corners only of cells with more nodes: 1"));
        EXPECT_THAT(notes_, Contains("divided into tets: hexahedra: 1"));
    };
    std::string middles;
    for (int k = 8; k < 27; ++k) middles += " 0";
    for (const int type : {25, 29, 33, 72, 80}) {
        const std::string nodes = "27 0 1 2 3 4 5 6 7" + middles;
        expect_cube("a.vtk",
                    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 11 double\n" +
                        mixed_coordinates() + "CELLS 1 28\n" + nodes + "\nCELL_TYPES 1\n" +
                        std::to_string(type) + "\n");
    }
    std::string msh = replaced(mixed_gmsh2(), "$Elements\n3\n1 5 2 7 1 1 2 3 4 5 6 7 8",
                               "$Elements\n1\n1 12 2 7 1 1 2 3 4 5 6 7 8" + middles);
    msh.erase(msh.find("2 6 2 8"));
    for (std::size_t at = msh.find(" 0 0 0 0"); (at = msh.find(" 0", at)) != std::string::npos;)
        msh[at + 1] = '1';
    expect_cube("a.msh", msh + "$EndElements\n");
    std::string medit = mixed_medit();  // as Gmsh writes them
    medit.erase(medit.find("Prisms"));
    for (char& c : middles) c = c == '0' ? '1' : c;
    expect_cube("a.mesh", replaced(medit, "1 2 3 4 5 6 7 8 7", "1 2 3 4 5 6 7 8" + middles + " 7"));
}

TEST_F(CellFileTest, WarnsOfVolumeThatIsLost) {
    for (const char* type : {"42", "41", "99"}) {
        read("a.vtk", replaced(mixed_vtk(), "\n12 13 14", std::string("\n12 13 ") + type));
        EXPECT_THAT(notes_, Contains(warning(std::string("the body lacks cells of a kind that Gelatin cannot "
                                                         "read, VTK's cell type ") +
                                             type + ": 1")));
    }
    const std::string medit = replaced(mixed_medit(), "Hexahedra", "HexahedraQ2\n0\nHexahedraQ3");
    read("a.mesh", medit);
    EXPECT_THAT(
        notes_,
        Contains(warning("the body lacks cells of a kind that Gelatin cannot read, Medit's HexahedraQ3: 1")));
    read("a.vtk", replaced(mixed_vtk(), "\n12 13 14", "\n12 13 9"));  // a surface is no part of the body
    EXPECT_THAT(notes_, Contains("ignored points, lines and surfaces: 1"));
}

TEST_F(CellFileTest, RefusesCellsWithOtherNumbersOfCorners) {
    EXPECT_THAT(refusal_of("a.vtk", replaced(mixed_vtk(), "\n12 13 14", "\n13 13 14")),
                HasSubstr("a.vtk: cell 1 = 8 points: wedges must have 6, curved ones more"));
    EXPECT_THAT(refusal_of("a.vtk", replaced(mixed_vtk(), "\n12 13 14", "\n12 13 12")),
                HasSubstr("a.vtk: cell 3 = 5 points: hexahedra must have 8"));
    EXPECT_THAT(refusal_of("a.mesh", replaced(mixed_medit(), "5 6 7 8 11 9", "5 6 7 8 12 9")),
                HasSubstr("Pyramids 1 = 12"));
}

// Some programs give each cell its own nodes.
TEST_F(CellFileTest, JoinsCellsByThePlacesOfTheirNodes) {
    for (unsigned reversed = 0; reversed < 8; ++reversed) {
        std::string points, cells;
        std::uint32_t first = 0;
        for (std::size_t c = 0; c < kMixedCells.size(); ++c) {
            std::vector<std::uint32_t> order = kMixedCells[c].corners;
            const auto size = static_cast<std::uint32_t>(order.size());
            const bool is_reversed = (reversed >> c & 1u) != 0;
            if (is_reversed) std::reverse(order.begin(), order.end());
            for (const std::uint32_t corner : order) {
                const glm::dvec3& p = kMixedNodes[corner];
                points += fmt::format("{} {} {}\n", p.x, p.y, p.z);
            }
            cells += fmt::format("{}", size);
            for (std::uint32_t k = 0; k < size; ++k)
                cells += fmt::format(" {}", first + (is_reversed ? size - 1 - k : k));
            cells += "\n";
            first += size;
        }
        const TetMesh mesh = read("a.vtk",
                                  "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                  "POINTS 19 double\n" +
                                      points + "CELLS 3 22\n" + cells + "CELL_TYPES 3\n12 13 14\n");
        EXPECT_THAT(notes_, Contains("merged nodes that coincide: 8"));
        EXPECT_EQ(mesh.faces.size(), 18u);
        EXPECT_DOUBLE_EQ(total_volume(mesh), kMixedVolume);
    }
}

}  // namespace
}  // namespace gelatin
