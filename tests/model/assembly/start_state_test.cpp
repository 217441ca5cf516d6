#include "model/assembly/start_state.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/test_models.h"

namespace gelatin {
namespace {

struct Start {
    Scene scene;
    Model model;
};

Start make_start(const StartDescription& second) {
    Body still = test::make_body(test::make_block({2, 2, 2}, {0.2, 0.2, 0.2})),
         moved = test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2));
    moved.pins = {HalfSpaceRegion{{1, 0, 0}, 1e-6}};
    Start start;
    start.model = pack_bodies({still, moved}, {}, {0, 0, 0});
    start.scene.objects.resize(2);
    start.scene.objects[1].start = second;
    return start;
}

TEST(DeformedStart, IsNothingWhereAllAreInShape) {
    const Start start = make_start({});
    EXPECT_FALSE(deformed_start(start.scene, start.model));
}

TEST(DeformedStart, ScalesAboutTheCentreOfMass) {
    const Start start = make_start({{1.0, 0.0, 0.5}, 0.0});
    const State state = *deformed_start(start.scene, start.model);
    const Range& nodes = start.model.objects[1].nodes;
    glm::dvec3 center(0.0);
    double mass = 0.0;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        center += static_cast<double>(start.model.masses[n]) * glm::dvec3(start.model.positions[n]);
        mass += static_cast<double>(start.model.masses[n]);
    }
    center /= mass;
    for (std::uint32_t n = 0; n < start.model.node_count(); ++n) {
        const glm::dvec3 rest(start.model.positions[n]);
        const bool stays = n < nodes.first || start.model.positions[n].w == 0.0f;
        const glm::dvec3 expected =
            stays ? rest : glm::dvec3(rest.x, center.y, center.z + 0.5 * (rest.z - center.z));
        EXPECT_LT(glm::distance(glm::dvec3(state.positions[n]), expected), 1e-7) << n;
        EXPECT_EQ(state.positions[n].w, start.model.positions[n].w);
    }
}

TEST(DeformedStart, ScattersWithinItsBoundsAndTheSameWay) {
    const Start start = make_start({glm::dvec3(1.0), 0.05});
    const State one = *deformed_start(start.scene, start.model),
                two = *deformed_start(start.scene, start.model);
    EXPECT_EQ(one.positions, two.positions);
    double furthest = 0.0;
    for (std::uint32_t n = 0; n < start.model.node_count(); ++n) {
        const glm::dvec3 displacement =
            glm::abs(glm::dvec3(one.positions[n]) - glm::dvec3(start.model.positions[n]));
        furthest = std::max({furthest, displacement.x, displacement.y, displacement.z});
    }
    EXPECT_LE(furthest, 0.05 + 1e-7);
    EXPECT_GT(furthest, 0.045);
}

}  // namespace
}  // namespace gelatin
