#include "cpu/contact/near_at_rest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <utility>

#include "cpu/collision/walk_tree.h"
#include "cpu/contact/contact_pair.h"
#include "cpu/contact/nearest_pairs.h"
#include "model/corners.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using LeafPair = std::pair<std::uint32_t, std::uint32_t>;

// A fork of two prongs, some 30 mm apart.
class NearAtRestTest : public ::testing::Test {
protected:
    NearAtRestTest() {
        const TetMesh block = test::make_block({5, 5, 2}, {0.5, 0.5, 0.2}, 0.1);
        const auto is_between = [](const glm::dvec3& p) { return p.y > 0.1 && p.x > 0.2 && p.x < 0.3; };
        TetMesh fork = test::without(block, is_between);
        for (glm::dvec3& p : fork.positions)
            if (p.x > 0.25) p.x -= 0.07;
        model_ = std::make_shared<const Model>(test::make_model(test::make_body(fork)));
        std::vector<cpu::AxisBox<double>> faces(model_->faces.size()), boxes(model_->face_trees.nodes.size());
        for (std::size_t f = 0; f < faces.size(); ++f)
            for (const std::uint32_t n : corners_of(model_->faces[f]))
                faces[f].add(glm::dvec3(glm::vec3(model_->positions[n])));
        cpu::update_tree_boxes<double>(model_->face_trees, model_->face_trees.roots[0], faces, boxes);
        near_.emplace(model_);
        near_->add(0, boxes);
    }

    // Turned, and the prongs bent towards each other.
    std::vector<glm::dvec4> moved(double angle, double bend) const {
        const glm::dquat turn = glm::angleAxis(angle, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
        std::vector<glm::dvec4> moved;
        for (const glm::vec4& p : model_->positions) {
            glm::dvec3 x{glm::vec3(p)};
            if (x.y > 0.1) x.x += bend * (x.x < 0.215 ? 1.0 : -1.0) * (x.y - 0.1) * (x.y - 0.1);
            moved.emplace_back(turn * x + glm::dvec3(3.0, 0.1, -2.0), 1.0);
        }
        return moved;
    }

    // The distance of the nearest node and face, or edges, of two leaves.
    std::map<LeafPair, double> nearest(const std::vector<glm::dvec4>& positions) const {
        std::vector<std::uint32_t> leaf_of(model_->faces.size());
        const std::vector<TreeNode>& nodes = model_->face_trees.nodes;
        for (std::uint32_t n = 0; n < nodes.size(); ++n)
            for (std::uint32_t k = 0; k < nodes[n].item_count; ++k) leaf_of[nodes[n].first_item + k] = n;
        const SurfaceParts& parts = model_->surface_parts;
        std::map<LeafPair, double> nearest;
        const auto measure = [&](const LeafPair& leaves, const cpu::ContactPair& pair) {
            cpu::MeasuredPairs<double> measured;
            cpu::measure_pairs({&pair, 1}, positions, measured);
            const auto [at, is_new] = nearest.emplace(leaves, measured.gaps[0]);
            if (!is_new) at->second = std::min(at->second, measured.gaps[0]);
        };
        for (std::uint32_t f = 0; f < model_->faces.size(); ++f) {
            const glm::uvec2 first = parts.face_starts[f], end = parts.face_starts[f + 1];
            for (std::uint32_t g = 0; g < model_->faces.size(); ++g) {
                const LeafPair leaves(leaf_of[f], leaf_of[g]);
                const Face& face = model_->faces[g];
                for (std::uint32_t s = first.x; s < end.x; ++s) {
                    const std::uint32_t n = parts.nodes[s];
                    if (!has_corner(face, n))
                        measure(leaves, {{n, face.a, face.b, face.c}, n, g, 0, 0, 1, 0});
                }
                const glm::uvec2 other = parts.face_starts[g], other_end = parts.face_starts[g + 1];
                for (std::uint32_t e = first.y; e < end.y; ++e)
                    for (std::uint32_t k = other.y; k < other_end.y; ++k) {
                        const FaceEdge &a = parts.edges[e], &b = parts.edges[k];
                        if (e != k && !share_end(a, b))
                            measure(leaves, {{a.a, a.b, b.a, b.b}, e, k, 0, 0, 2, 0});
                    }
            }
        }
        return nearest;
    }

    std::shared_ptr<const Model> model_;
    std::optional<cpu::NearAtRest<double>> near_;
};

TEST_F(NearAtRestTest, FindsAllLeavesThatComeNear) {
    constexpr double kWithin = 0.02;
    std::size_t near = 0;
    for (const double turned : {0.0, 0.3, 1.5})
        for (const double bend : {0.0, 0.05, 0.15}) {
            const std::vector<glm::dvec4> from = moved(0.4, 0.0), to = moved(0.4 + turned, bend);
            near_->begin(0, from, to, kWithin);
            ASSERT_TRUE(near_->is_enough(0)) << turned << ' ' << bend;
            std::map<std::uint32_t, std::vector<std::uint32_t>> lists;
            for (const double part : {0.0, 0.3, 0.5, 0.8, 1.0}) {
                std::vector<glm::dvec4> between;
                for (std::size_t n = 0; n < from.size(); ++n)
                    between.push_back(glm::mix(from[n], to[n], part));
                for (const auto& [leaves, gap] : nearest(between)) {
                    std::vector<std::uint32_t>& list = lists[leaves.first];
                    if (list.empty()) near_->find(0, leaves.first, list);
                    if (gap > kWithin) continue;
                    ++near;
                    EXPECT_TRUE(std::binary_search(list.begin(), list.end(), leaves.second))
                        << turned << ' ' << bend << ' ' << part << ": " << gap;
                }
            }
        }
    EXPECT_GT(near, 0u);
}

// The prongs meet, or they were far from each other and are no more.
TEST_F(NearAtRestTest, KnowsWhenOthersMayMeet) {
    const std::vector<glm::dvec4> from = moved(0.0, 0.0);
    near_->begin(0, from, moved(0.0, 0.5), 0.02);
    EXPECT_FALSE(near_->is_enough(0));
    near_->begin(0, from, moved(3.0, 0.0), 0.02);
    EXPECT_FALSE(near_->is_enough(0)) << "half a turn, through its middle";
    near_->begin(0, from, from, 0.02);
    EXPECT_TRUE(near_->is_enough(0));
    std::size_t listed = 0, leaves = 0;
    for (std::uint32_t n = 0; n < model_->face_trees.nodes.size(); ++n) {
        if (model_->face_trees.nodes[n].item_count == 0) continue;
        std::vector<std::uint32_t> list;
        near_->find(0, n, list);
        listed += list.size();
        ++leaves;
    }
    EXPECT_LT(listed, leaves) << "most are farther from each other than that";
}

}  // namespace
}  // namespace gelatin
