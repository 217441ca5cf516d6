#include "mesh/topology.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <random>
#include <set>

namespace gelatin {
namespace {

using testing::ElementsAre;

// A grid of n^3 unit cubes, each cut into six tets around its long diagonal (Kuhn).
TetMesh make_grid(std::uint32_t n) {
    TetMesh mesh;
    for (std::uint32_t z = 0; z <= n; ++z) {
        for (std::uint32_t y = 0; y <= n; ++y) {
            for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.emplace_back(x, y, z);
        }
    }
    const std::uint32_t side[3] = {1, n + 1, (n + 1) * (n + 1)};
    for (std::uint32_t z = 0; z < n; ++z) {
        for (std::uint32_t y = 0; y < n; ++y) {
            for (std::uint32_t x = 0; x < n; ++x) {
                const std::uint32_t first = x * side[0] + y * side[1] + z * side[2];
                int axes[3] = {0, 1, 2};
                do {
                    const std::uint32_t b = first + side[axes[0]], c = b + side[axes[1]],
                                        d = c + side[axes[2]];
                    glm::uvec4 tet{first, b, c, d};
                    if (tet_volume(mesh, tet) < 0.0) std::swap(tet[1], tet[2]);
                    mesh.tets.push_back(tet);
                } while (std::next_permutation(axes, axes + 3));
            }
        }
    }
    return mesh;
}

// The edges of an nx by ny grid, its nodes numbered at random.
std::vector<glm::uvec2> make_shuffled_net(std::uint32_t nx, std::uint32_t ny) {
    std::vector<std::uint32_t> number(nx * ny);
    std::iota(number.begin(), number.end(), 0u);
    std::shuffle(number.begin(), number.end(), std::mt19937(7));
    std::vector<glm::uvec2> edges;
    for (std::uint32_t y = 0; y < ny; ++y) {
        for (std::uint32_t x = 0; x < nx; ++x) {
            if (x + 1 < nx) edges.emplace_back(number[y * nx + x], number[y * nx + x + 1]);
            if (y + 1 < ny) edges.emplace_back(number[y * nx + x], number[(y + 1) * nx + x]);
        }
    }
    return edges;
}

std::uint32_t bandwidth(const Graph& graph, const std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> place(order.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) place[order[k]] = k;
    std::uint32_t width = 0;
    for (std::uint32_t n = 0; n < order.size(); ++n) {
        for (const std::uint32_t other : graph.row(n)) {
            width = std::max(width, std::max(place[n], place[other]) - std::min(place[n], place[other]));
        }
    }
    return width;
}

bool is_permutation_of_indices(std::vector<std::uint32_t> order) {
    std::sort(order.begin(), order.end());
    for (std::uint32_t k = 0; k < order.size(); ++k) {
        if (order[k] != k) return false;
    }
    return true;
}

const TetMesh kTwoTets{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {4, 2, 1, 3}}, {}};

TEST(Topology, TetVolumeHasTheSignOfTheWinding) {
    EXPECT_DOUBLE_EQ(tet_volume(kTwoTets, {0, 1, 2, 3}), 1.0 / 6.0);
    EXPECT_DOUBLE_EQ(tet_volume(kTwoTets, {0, 2, 1, 3}), -1.0 / 6.0);
    EXPECT_GT(tet_volume(kTwoTets, kTwoTets.tets[1]), 0.0);
}

TEST(Topology, TetEdgesAreUniqueAndAscending) {
    using Edge = glm::uvec2;
    EXPECT_THAT(tet_edges(kTwoTets.tets),
                ElementsAre(Edge(0, 1), Edge(0, 2), Edge(0, 3), Edge(1, 2), Edge(1, 3), Edge(1, 4),
                            Edge(2, 3), Edge(2, 4), Edge(3, 4)));
    EXPECT_TRUE(tet_edges({}).empty());
}

TEST(Topology, EdgesOfAGridAgreeWithASet) {
    const TetMesh mesh = make_grid(5);
    std::set<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (const glm::uvec4& tet : mesh.tets) {
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                if (tet[i] < tet[j]) expected.emplace(tet[i], tet[j]);
            }
        }
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> actual;
    for (const glm::uvec2& edge : tet_edges(mesh.tets)) actual.emplace_back(edge[0], edge[1]);
    EXPECT_EQ(actual, decltype(actual)(expected.begin(), expected.end()));
}

TEST(Topology, GraphRowsAreSortedWhateverTheOrderOfEdges) {
    const glm::uvec2 edges[] = {{3, 0}, {1, 0}, {2, 3}, {0, 2}};
    const Graph graph = make_graph(5, edges);
    EXPECT_THAT(graph.row(0), ElementsAre(1, 2, 3));
    EXPECT_THAT(graph.row(1), ElementsAre(0));
    EXPECT_THAT(graph.row(2), ElementsAre(0, 3));
    EXPECT_THAT(graph.row(3), ElementsAre(0, 2));
    EXPECT_EQ(graph.degree(4), 0u);
    EXPECT_TRUE(graph.connects(3, 2));
    EXPECT_FALSE(graph.connects(1, 2));
    EXPECT_FALSE(graph.connects(4, 0));
}

TEST(Topology, BoundaryOfAGridIsItsClosedOutwardHull) {
    const std::uint32_t n = 4;
    const TetMesh mesh = make_grid(n);
    const std::vector<glm::uvec3> faces = boundary_faces(mesh.tets);
    EXPECT_EQ(faces.size(), 6u * n * n * 2u);

    double volume = 0.0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges;
    for (const glm::uvec3& face : faces) {
        const glm::dvec3 a = mesh.positions[face[0]], b = mesh.positions[face[1]],
                         c = mesh.positions[face[2]];
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
        for (int k = 0; k < 3; ++k) ++directed_edges[{face[k], face[(k + 1) % 3]}];
    }
    EXPECT_NEAR(volume, double{n} * n * n, 1e-9);
    for (const auto& [edge, count] : directed_edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(directed_edges.count({edge.second, edge.first}), 1u);
    }
}

TEST(Topology, InnerFaceNamesTheOppositeCorners) {
    const std::vector<InnerFace> faces = inner_faces(kTwoTets.tets);
    ASSERT_EQ(faces.size(), 1u);
    EXPECT_THAT(faces[0].tets, ElementsAre(0, 1));
    EXPECT_THAT(faces[0].corners, ElementsAre(0, 4));
}

TEST(Topology, EveryFaceOfAGridIsInnerOrBoundary) {
    const TetMesh mesh = make_grid(5);
    EXPECT_EQ(2 * inner_faces(mesh.tets).size() + boundary_faces(mesh.tets).size(), 4 * mesh.tets.size());
    for (const InnerFace& face : inner_faces(mesh.tets)) {
        EXPECT_LT(face.tets[0], face.tets[1]);
        for (int side = 0; side < 2; ++side) {
            const glm::uvec4& own = mesh.tets[face.tets[side]];
            const glm::uvec4& other = mesh.tets[face.tets[1 - side]];
            const std::uint32_t corner = face.corners[side];
            EXPECT_TRUE(corner == own[0] || corner == own[1] || corner == own[2] || corner == own[3]);
            EXPECT_TRUE(corner != other[0] && corner != other[1] && corner != other[2] && corner != other[3]);
        }
    }
}

TEST(Topology, SurfaceEdgesSkipBorders) {
    const glm::uvec3 faces[] = {{0, 1, 2}, {2, 1, 3}};
    const std::vector<SurfaceEdge> edges = surface_edges(faces);
    ASSERT_EQ(edges.size(), 1u);
    EXPECT_EQ(edges[0].nodes, glm::uvec2(1, 2));
    EXPECT_THAT(edges[0].faces, ElementsAre(0, 1));
    EXPECT_THAT(edges[0].corners, ElementsAre(0, 3));
}

TEST(Topology, ClosedSurfaceHasThreeHalfEdgesAFace) {
    const std::vector<glm::uvec3> faces = boundary_faces(make_grid(3).tets);
    EXPECT_EQ(surface_edges(faces).size(), faces.size() * 3 / 2);
}

TEST(LocalityOrder, NarrowsTheBandToTheShortSideOfANet) {
    const Graph graph = make_graph(60 * 7, make_shuffled_net(60, 7));
    const std::vector<std::uint32_t> order = locality_order(graph, 1);
    ASSERT_TRUE(is_permutation_of_indices(order));
    // Levels from a corner of a grid are its diagonals, of at most 7 nodes; an edge spans two levels.
    EXPECT_LE(bandwidth(graph, order), 2 * 7u);
    EXPECT_EQ(locality_order(graph, 1), order);
}

TEST(LocalityOrder, KeepsComponentsTogether) {
    std::vector<glm::uvec2> edges = make_shuffled_net(9, 4);
    for (glm::uvec2& edge : edges) edge *= 2u;  // one net on the even nodes ...
    const std::size_t net_edges = edges.size();
    for (std::size_t e = 0; e < net_edges; ++e)
        edges.push_back(edges[e] + 1u);                 // ... its twin on the odd ones
    const Graph graph = make_graph(2 * 36 + 1, edges);  // and a node alone

    const std::vector<std::uint32_t> order = locality_order(graph, 1);
    ASSERT_TRUE(is_permutation_of_indices(order));
    for (std::size_t k = 0; k < 36; ++k) {
        EXPECT_EQ(order[k] % 2, 0u);
        EXPECT_EQ(order[36 + k] % 2, 1u);
    }
    EXPECT_EQ(order.back(), 72u);
}

TEST(LocalityOrder, SortsByDegreeWithinWindowsOnly) {
    const Graph graph = make_graph(30 * 11, make_shuffled_net(30, 11));
    const std::uint32_t window = 64;  // 330 % 64 != 0
    const std::vector<std::uint32_t> plain = locality_order(graph, 1);
    const std::vector<std::uint32_t> sorted = locality_order(graph, window);
    for (std::size_t begin = 0; begin < sorted.size(); begin += window) {
        const auto end = std::min<std::size_t>(begin + window, sorted.size());
        std::vector<std::uint32_t> expected(plain.begin() + static_cast<std::ptrdiff_t>(begin),
                                            plain.begin() + static_cast<std::ptrdiff_t>(end));
        std::stable_sort(expected.begin(), expected.end(),
                         [&](auto a, auto b) { return graph.degree(a) > graph.degree(b); });
        EXPECT_TRUE(std::equal(expected.begin(), expected.end(),
                               sorted.begin() + static_cast<std::ptrdiff_t>(begin)));
    }
}

TEST(LocalityOrder, TakesAnEmptyGraph) {
    EXPECT_TRUE(locality_order(make_graph(0, {}), 256).empty());
}

}  // namespace
}  // namespace gelatin
