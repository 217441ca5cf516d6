#include "model/face_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>

#include "support/test_models.h"

namespace gelatin {
namespace {

// Two bodies: one of a single tet, one of many faces, whose number is no power of four.
Model make_model_of_two() {
    Body tet = test::make_body(test::make_block({1, 1, 1}, {1, 1, 1}));
    tet.mesh.tets.resize(1);
    tet.mesh.faces = {{tet.mesh.tets[0].x, tet.mesh.tets[0].z, tet.mesh.tets[0].y},
                      {tet.mesh.tets[0].x, tet.mesh.tets[0].y, tet.mesh.tets[0].w},
                      {tet.mesh.tets[0].y, tet.mesh.tets[0].z, tet.mesh.tets[0].w},
                      {tet.mesh.tets[0].z, tet.mesh.tets[0].x, tet.mesh.tets[0].w}};
    Body body = test::make_body(test::make_block({5, 6, 7}, {5, 6, 7}));
    Model model;
    for (const Body* b : {&tet, &body}) {
        std::vector<glm::uvec3> faces = b->mesh.faces;
        arrange_faces(b->mesh.positions, faces);
        ModelObject object;
        object.faces = {static_cast<std::uint32_t>(model.faces.size()),
                        static_cast<std::uint32_t>(faces.size())};
        for (const glm::uvec3& f : faces) model.faces.push_back({f.x, f.y, f.z, 0});
        append_face_tree(object.faces, model.face_tree);
        model.objects.push_back(object);
    }
    return model;
}

TEST(FaceTree, LeavesHoldEveryFaceOnceInOrder) {
    const Model model = make_model_of_two();
    const FaceTree& tree = model.face_tree;
    for (std::size_t o = 0; o < 2; ++o) {
        const std::uint32_t root = tree.roots[o];
        EXPECT_EQ(tree.nodes[root].root_of, o);
        std::uint32_t next = model.objects[o].faces.first;
        for (std::uint32_t n = root; n < tree.nodes[root].skip; ++n) {
            const TreeNode& node = tree.nodes[n];
            if (node.face_count == 0) continue;
            EXPECT_EQ(node.skip, n + 1);
            EXPECT_EQ(node.first_face, next);
            EXPECT_EQ((node.first_face - model.objects[o].faces.first) % 4, 0u)
                << "leaf k has the faces from 4 k on";
            next += node.face_count;
            EXPECT_TRUE(node.face_count == 4 || next == model.objects[o].faces.end());
        }
        EXPECT_EQ(next, model.objects[o].faces.end());
    }
    EXPECT_EQ(tree.nodes.size(), tree.nodes[tree.roots[1]].skip);
}

TEST(FaceTree, InnerNodesHaveTwoToFourChildrenOnLowerLevels) {
    const FaceTree tree = make_model_of_two().face_tree;
    std::vector<std::size_t> level_of(tree.nodes.size(), 99);
    std::size_t listed = 0;
    for (std::size_t level = 0; level < tree.levels.size(); ++level) {
        for (const std::uint32_t n : tree.levels[level]) level_of[n] = level;
        listed += tree.levels[level].size();
    }
    EXPECT_EQ(listed, tree.nodes.size());
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
        std::size_t children = 0;
        for (std::uint32_t child = n + 1; child < tree.nodes[n].skip; child = tree.nodes[child].skip) {
            EXPECT_LT(level_of[child], level_of[n]);
            ++children;
        }
        EXPECT_EQ(children == 0, tree.nodes[n].face_count > 0);
        EXPECT_TRUE(children == 0 || (children >= 2 && children <= 4));
    }
}

TEST(FaceTree, ArrangingKeepsTheFacesAndBringsNeighboursTogether) {
    const TetMesh mesh = test::make_block({8, 8, 8}, {1, 1, 1});
    std::vector<glm::uvec3> faces = mesh.faces;
    arrange_faces(mesh.positions, faces);
    const auto spread = [&](const std::vector<glm::uvec3>& order) {
        double sum = 0.0;
        for (std::size_t f = 0; f + 4 <= order.size(); f += 4) {
            glm::dvec3 min(9.0), max(-9.0);
            for (std::size_t k = 0; k < 4; ++k) {
                for (int c = 0; c < 3; ++c) {
                    min = glm::min(min, mesh.positions[order[f + k][c]]);
                    max = glm::max(max, mesh.positions[order[f + k][c]]);
                }
            }
            sum += glm::length(max - min);
        }
        return sum;
    };
    EXPECT_LT(spread(faces), 0.8 * spread(mesh.faces));
    const auto less = [](const glm::uvec3& a, const glm::uvec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::vector<glm::uvec3> before = mesh.faces;
    std::sort(before.begin(), before.end(), less);
    std::sort(faces.begin(), faces.end(), less);
    EXPECT_EQ(faces, before);
}

}  // namespace
}  // namespace gelatin
