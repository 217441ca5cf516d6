#include "model/collision/surface_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "model/collision/node_faces.h"
#include "support/crowd.h"

namespace gelatin {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

SurfaceParts make_parts(std::uint32_t nodes, const std::vector<Face>& faces) {
    return make_surface_parts(faces, make_node_faces(nodes, faces));
}

std::vector<Edge> edges_of(const SurfaceParts& parts) {
    std::vector<Edge> edges;
    for (const FaceEdge& edge : parts.edges) edges.emplace_back(edge.a, edge.b);
    return edges;
}

// By the first face that has it, each node and each edge is expected in that face's range.
void expect_owners(const SurfaceParts& parts, const std::vector<Face>& faces) {
    std::map<std::uint32_t, std::uint32_t> node_owners;
    std::map<Edge, std::uint32_t> edge_owners;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t n[3] = {faces[f].a, faces[f].b, faces[f].c};
        for (int k = 0; k < 3; ++k) {
            node_owners.emplace(n[k], f);
            const Edge edge = std::minmax(n[k], n[(k + 1) % 3]);
            if (edge.first != edge.second) edge_owners.emplace(edge, f);
        }
    }
    ASSERT_EQ(parts.face_starts.size(), faces.size() + 1);
    EXPECT_EQ(parts.nodes.size(), node_owners.size());
    EXPECT_EQ(parts.edges.size(), edge_owners.size());
    EXPECT_EQ(parts.face_starts.back(), glm::uvec2(parts.nodes.size(), parts.edges.size()));
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        for (std::uint32_t k = parts.face_starts[f].x; k < parts.face_starts[f + 1].x; ++k) {
            EXPECT_EQ(node_owners.at(parts.nodes[k]), f);
            node_owners.erase(parts.nodes[k]);  // once
        }
        for (std::uint32_t k = parts.face_starts[f].y; k < parts.face_starts[f + 1].y; ++k) {
            const FaceEdge& edge = parts.edges[k];
            EXPECT_EQ(edge_owners.at({edge.a, edge.b}), f);
            EXPECT_EQ(edge.face, f);
            EXPECT_EQ(edge.object, faces[f].object);
            edge_owners.erase({edge.a, edge.b});
        }
    }
}

TEST(SurfaceParts, OfACrowd) {
    const Model model = test::make_crowd(7);
    expect_owners(model.surface_parts, model.faces);
    // Closed: Euler's V - E + F = 2 a body.
    EXPECT_EQ(model.surface_parts.nodes.size() + model.faces.size(),
              model.surface_parts.edges.size() + 2 * 7);
}

TEST(SurfaceParts, OfASurfaceThatIsOpen) {
    const std::vector<Face> faces{{0, 1, 2, 0}, {2, 1, 3, 0}};
    const SurfaceParts parts = make_parts(4, faces);
    EXPECT_EQ(edges_of(parts), (std::vector<Edge>{{0, 1}, {1, 2}, {0, 2}, {1, 3}, {2, 3}}));
    EXPECT_EQ(parts.nodes, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    expect_owners(parts, faces);
}

TEST(SurfaceParts, OfThreeFacesAtAnEdgeAndOneThatIsThereTwice) {
    const std::vector<Face> faces{{4, 5, 0, 0}, {5, 4, 1, 0}, {4, 5, 2, 0}, {4, 5, 2, 0}};
    expect_owners(make_parts(7, faces), faces);  // nodes 3 and 6 lie inside
}

TEST(SurfaceParts, OfFacesWithoutArea) {
    const std::vector<Face> faces{{1, 1, 2, 0}, {3, 3, 3, 0}, {2, 1, 3, 0}};
    const SurfaceParts parts = make_parts(4, faces);
    EXPECT_EQ(edges_of(parts), (std::vector<Edge>{{1, 2}, {1, 3}, {2, 3}}));
    expect_owners(parts, faces);
}

}  // namespace
}  // namespace gelatin
