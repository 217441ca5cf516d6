#include "model/drive/acted_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gelatin {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Pull make_pull(std::vector<Pull::Node> nodes, const glm::dvec3& target, double damping_time) {
    Pull pull;
    pull.nodes = std::move(nodes);
    pull.target = target;
    pull.damping_time = damping_time;
    return pull;
}

TEST(ActedNodes, HaveTheSpringAndTheForceOfEach) {
    ActedNodes acted(6);
    EXPECT_THAT(acted.by_node(), IsEmpty());
    acted.set_pulls({make_pull({{4, glm::vec3(1, 0, 0), 3.0f}}, {0, 2, 0}, 0.5)});
    std::vector<glm::vec3> forces(6, glm::vec3(0.0f));
    forces[1] = {7, 8, 9};
    forces[4] = {1, 2, 3};
    acted.set_forces(forces);
    EXPECT_THAT(acted.nodes(), ElementsAre(1u, 4u));
    EXPECT_EQ(acted.by_node()[4].spring, glm::vec4(1, 2, 0, 3));
    EXPECT_EQ(acted.by_node()[4].force, glm::vec4(1, 2, 3, 0.5f));
    EXPECT_EQ(acted.by_node()[1].spring, glm::vec4(0.0f));
    EXPECT_EQ(acted.by_node()[1].force, glm::vec4(7, 8, 9, 0));
    acted.move_pull(0, {0, 5, 0});
    EXPECT_EQ(acted.by_node()[4].spring, glm::vec4(1, 5, 0, 3));
    EXPECT_EQ(acted.by_node()[4].force, glm::vec4(1, 2, 3, 0.5f));
    acted.set_forces({});
    EXPECT_THAT(acted.nodes(), ElementsAre(4u));
    acted.set_pulls({});
    EXPECT_THAT(acted.nodes(), IsEmpty());
    for (const NodeActions& node : acted.by_node()) {
        EXPECT_EQ(node.spring, glm::vec4(0.0f));
        EXPECT_EQ(node.force, glm::vec4(0.0f));
    }
}

// k1 (p1 - x) + k2 (p2 - x) = (k1 + k2) (p - x), and the same of the dampings k t.
TEST(ActedNodes, SpringsOfSeveralHandsActAsOne) {
    ActedNodes acted(3);
    acted.set_pulls({make_pull({{0, {}, 1.0f}, {2, {}, 5.0f}}, {4, 0, 0}, 0.8),
                     make_pull({{0, glm::vec3(0, 0, 1), 3.0f}}, {0, 8, 0}, 0.4)});
    EXPECT_THAT(acted.nodes(), ElementsAre(0u, 2u));
    const glm::vec4 spring = acted.by_node()[0].spring;
    EXPECT_FLOAT_EQ(spring.x, 1.0f);
    EXPECT_FLOAT_EQ(spring.y, 6.0f);
    EXPECT_FLOAT_EQ(spring.z, 0.75f);
    EXPECT_FLOAT_EQ(spring.w, 4.0f);
    EXPECT_FLOAT_EQ(acted.by_node()[0].force.w, 0.5f);
    EXPECT_EQ(acted.by_node()[2].spring, glm::vec4(4, 0, 0, 5));
}

}  // namespace
}  // namespace gelatin
