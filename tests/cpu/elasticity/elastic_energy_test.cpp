#include "cpu/elasticity/elastic_energy.h"

#include <gtest/gtest.h>

#include "support/contact_scenes.h"

namespace gelatin {
namespace {

// Of flat tets: none at rest, and what mirrored ones hold, whose J is -1: V K / 2 (J_0 - J)^2 with J_0 = 1/2.
TEST(ElasticEnergy, OfFlatTetsIsThatOfMirroredOnes) {
    const auto model = test::make_blocks({{.size = {0.3, 0.4, 0.5}, .youngs_modulus = 2e4}});
    const Range& tets = model->objects[0].tets;
    std::vector<glm::dvec4> positions(model->positions.begin(), model->positions.end());
    EXPECT_NEAR(cpu::flat_tet_energy<double>(*model, tets, positions), 0.0, 1e-12);
    for (glm::dvec4& p : positions) p.x = -p.x;
    const double mirrored = 0.5 * 2e4 * 0.3 * 0.4 * 0.5 * 1.5 * 1.5;
    EXPECT_NEAR(cpu::flat_tet_energy<double>(*model, tets, positions), mirrored, 1e-4 * mirrored);
}

// Bodies with more elements than a task has.
TEST(ElasticEnergy, OfABodyIsThatOfAllItsElements) {
    for (const MaterialModel kind : {MaterialModel::mass_spring, MaterialModel::neo_hookean}) {
        const auto model = test::make_blocks(
            {{}, {.place = {1, 0, 0}, .cells = {10, 10, 10}, .poisson_ratio = 0.35, .model = kind}});
        const ModelObject& body = model->objects[1];
        ASSERT_GT(body.springs.count + body.neo_hookean_tets.count, 4096u);
        std::vector<glm::dvec4> positions(model->positions.begin(), model->positions.end());
        for (glm::dvec4& p : positions) p.x = -0.9 * p.x + 0.1 * p.y * p.y;  // mirrored: tets are flat, too
        double expected =
            cpu::elastic_energy<double>(*model, {body.nodes, body.springs, body.neo_hookean_tets}, positions);
        if (kind == MaterialModel::mass_spring)
            expected += cpu::flat_tet_energy<double>(*model, body.tets, positions);
        EXPECT_NEAR(cpu::body_energy<double>(*model, body, positions), expected, 1e-12 * expected);
        const std::vector<glm::vec4> rounded(positions.begin(), positions.end());
        EXPECT_NEAR(cpu::body_energy<float>(*model, body, rounded), expected, 1e-6 * expected);
    }
}

}  // namespace
}  // namespace gelatin
