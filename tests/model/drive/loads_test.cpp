#include "model/drive/loads.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "cpu/drive/sum_loads.h"
#include "model/model.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

const Region kEverywhere = HalfSpaceRegion{{1.0, 0.0, 0.0}, 100.0};

Model loaded_block(const std::vector<LoadDescription>& loads) {
    Body body = test::make_body(test::make_block({4, 5, 3}, {0.4, 0.5, 0.3}, 0.2));
    body.loads = loads;
    return test::make_model(body);
}

std::vector<glm::dvec4> forces_of(const Model& model, const std::vector<glm::dvec4>& positions) {
    std::vector<glm::dvec4> forces(model.node_count(), glm::dvec4(0.0));
    const std::vector<float> factors(model.loads.spans.size(), 1.0f);
    cpu::sum_loads<double>(model.loads, factors, positions, forces);
    return forces;
}

std::vector<glm::dvec4> forces_of(const Model& model) {
    return forces_of(model, {model.positions.begin(), model.positions.end()});
}

glm::dvec3 sum_of(const std::vector<glm::dvec4>& forces) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec4& f : forces) sum += glm::dvec3(f);
    return sum;
}

TEST(Loads, AForceIsSharedByMass) {
    const Model model = loaded_block({{HalfSpaceRegion{{0.0, 1.0, 0.0}, 0.11}, ForceLoad{{2.0, -3.0, 5.0}}}});
    const std::vector<glm::dvec4> forces = forces_of(model);
    EXPECT_LT(glm::distance(sum_of(forces), glm::dvec3(2.0, -3.0, 5.0)), 1e-6);
    double mass = 0.0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        if (model.positions[n].y <= 0.11f) mass += static_cast<double>(model.masses[n]);
    }
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const double share =
            model.positions[n].y <= 0.11f ? static_cast<double>(model.masses[n]) / mass : 0.0;
        EXPECT_NEAR(forces[n].x, 2.0 * share, 1e-6);
    }
}

// Stress times the area of the end, 0.5 x 0.3 m; inner faces and the sides have none of it.
TEST(Loads, ATractionActsOnTheFacesInItsRegion) {
    const Model model =
        loaded_block({{HalfSpaceRegion{{-1.0, 0.0, 0.0}, -0.39}, TractionLoad{{100.0, 20.0, 0.0}}}});
    const std::vector<glm::dvec4> forces = forces_of(model);
    EXPECT_LT(glm::distance(sum_of(forces), 0.15 * glm::dvec3(100.0, 20.0, 0.0)), 1e-5);
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        EXPECT_EQ(glm::length(glm::dvec3(forces[n])) > 0.0, model.positions[n].x > 0.39f);
}

TEST(Loads, APressureAcrossAClosedSurfaceHasNoSum) {
    const Model model = loaded_block({{kEverywhere, PressureLoad{1000.0}}});
    std::vector<glm::dvec4> positions(model.positions.begin(), model.positions.end());
    for (glm::dvec4& p : positions) p.x += 0.3 * p.y * p.y + 0.1 * p.z;  // and in any shape
    const std::vector<glm::dvec4> forces = forces_of(model, positions);
    double size = 0.0;
    glm::dvec3 moment(0.0);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        size += glm::length(glm::dvec3(forces[n]));
        moment += glm::cross(glm::dvec3(positions[n]), glm::dvec3(forces[n]));
    }
    EXPECT_GT(size, 500.0);
    EXPECT_LT(glm::length(sum_of(forces)), 1e-10 * size);
    EXPECT_LT(glm::length(moment), 1e-10 * size);
}

// On the end at x = 0.4 inwards, which is -x; once it is bent to face along -y, along +y: it follows.
TEST(Loads, APressureFollowsItsFaces) {
    const Model model = loaded_block({{HalfSpaceRegion{{-1.0, 0.0, 0.0}, -0.39}, PressureLoad{1000.0}}});
    EXPECT_LT(glm::distance(sum_of(forces_of(model)), glm::dvec3(-150.0, 0.0, 0.0)), 1e-4);
    std::vector<glm::dvec4> turned(model.positions.begin(), model.positions.end());
    for (glm::dvec4& p : turned) p = {p.y, -p.x, p.z, p.w};
    EXPECT_LT(glm::distance(sum_of(forces_of(model, turned)), glm::dvec3(0.0, 150.0, 0.0)), 1e-4);
    for (glm::dvec4& p : turned) p.z *= 2.0;
    EXPECT_LT(glm::distance(sum_of(forces_of(model, turned)), glm::dvec3(0.0, 300.0, 0.0)), 1e-4);
}

// All together are the sum of each alone; each node is there once.
TEST(Loads, AddUp) {
    const LoadDescription loads[] = {{kEverywhere, PressureLoad{700.0}},
                                     {HalfSpaceRegion{{0.0, 1.0, 0.0}, 0.11}, ForceLoad{{2.0, -3.0, 5.0}}},
                                     {kEverywhere, TractionLoad{{0.0, 10.0, 0.0}}}};
    const Model all = loaded_block({loads[0], loads[1], loads[2]});
    const std::vector<glm::dvec4> together = forces_of(all);
    std::vector<glm::dvec4> sum(all.node_count(), glm::dvec4(0.0));
    for (const LoadDescription& load : loads) {
        const std::vector<glm::dvec4> alone = forces_of(loaded_block({load}));
        for (std::uint32_t n = 0; n < all.node_count(); ++n) sum[n] += alone[n];
    }
    for (std::uint32_t n = 0; n < all.node_count(); ++n)
        EXPECT_LT(glm::distance(glm::dvec3(sum[n]), glm::dvec3(together[n])), 1e-9);
    for (std::size_t k = 1; k < all.loads.nodes.size(); ++k) {
        EXPECT_GT(all.loads.nodes[k].node, all.loads.nodes[k - 1].node);
        EXPECT_EQ(all.loads.nodes[k].first, all.loads.nodes[k - 1].end);
    }
    EXPECT_EQ(all.loads.nodes.back().end, all.loads.entries.size());
}

// Over steps that do not fit the span, what is given in all is the span's length.
TEST(Loads, ActInTheirSpanAlone) {
    LoadDescription load{kEverywhere, ForceLoad{{1.0, 0.0, 0.0}}};
    load.from = 0.105;
    load.until = 0.333;
    const Model model = loaded_block({load, {kEverywhere, PressureLoad{1.0}}});
    double given = 0.0;
    for (int s = 0; s < 50; ++s) {
        const double time = 0.01 * s;
        const std::vector<float> factors = load_factors(model.loads, time, 0.01);
        given += 0.01 * static_cast<double>(factors[0]);
        EXPECT_EQ(factors[1], 1.0f);
        if (time + 0.01 < 0.105 || time > 0.333) {
            EXPECT_EQ(factors[0], 0.0f);
        }
        if (time > 0.105 && time + 0.01 < 0.333) {
            EXPECT_EQ(factors[0], 1.0f);
        }
    }
    EXPECT_NEAR(given, 0.228, 1e-6);
    EXPECT_NEAR(load_factors(model.loads, 0.0, 1.0)[0], 0.228f, 1e-6f) << "within one step";
}

}  // namespace
}  // namespace gelatin
