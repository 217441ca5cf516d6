#include <gtest/gtest.h>

#include "cpu/implicit/elastic_system.h"
#include "model/contact/contact_surface.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// Of bodies at rest, held against the elements of the implicit step.
void expect_trace_of_elements(MaterialModel kind, double poisson_ratio) {
    Body body = test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2));
    body.material.model = kind;
    body.material.poisson_ratio = poisson_ratio;
    if (kind == MaterialModel::neo_hookean) body.material.springs.reset();
    const auto model = std::make_shared<const Model>(test::make_model(body));
    const ContactSurface surface = make_contact_surface(*model, {.friction = 0.4});
    cpu::ElasticSystem<double> system(model);
    const std::vector<glm::dvec4> positions(model->positions.begin(), model->positions.end()),
        velocities(positions.size(), glm::dvec4(0.0));  // undamped
    system.linearise(positions, velocities, 60.0);
    const auto blocks = system.diagonal();
    ASSERT_EQ(blocks.size(), model->node_count());
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        const glm::dvec3& diagonal = blocks[n].diagonal;
        const double expected = (diagonal.x + diagonal.y + diagonal.z) / 3.0;
        EXPECT_NEAR(static_cast<double>(surface.stiffness[n]), expected, 0.01 * expected);
    }
}

TEST(NodeStiffness, IsThatOfTheElementsAtRest) {
    for (const double poisson_ratio : {0.25, 0.4}) {
        expect_trace_of_elements(MaterialModel::mass_spring, poisson_ratio);
        expect_trace_of_elements(MaterialModel::neo_hookean, poisson_ratio);
    }
}

}  // namespace
}  // namespace gelatin
