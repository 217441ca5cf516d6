#include <gtest/gtest.h>

#include "cpu/descent/step_objective.h"
#include "model/contact/contact_surface.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// Of bodies at rest, held against the elements that block descent sums.
void expect_trace_of_elements(MaterialModel kind, double poisson_ratio) {
    Body body = test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2));
    body.material.model = kind;
    body.material.poisson_ratio = poisson_ratio;
    if (kind == MaterialModel::neo_hookean) body.material.springs.reset();
    const auto model = std::make_shared<const Model>(test::make_model(body));
    const ContactSurface surface = make_contact_surface(*model, {.friction = 0.4});
    cpu::StepObjective<double> objective(model, model->node_count());
    std::vector<glm::dvec4> positions(model->positions.begin(), model->positions.end());
    objective.step.starts = objective.step.targets = positions;
    for (glm::dvec4& start : objective.step.starts) start.w = 0.0;     // undamped
    for (glm::dvec4& target : objective.step.targets) target.w = 0.0;  // without inertia
    objective.begin(1.0 / 60.0);
    for (std::size_t batch = 0; batch < objective.rows().batches.size(); ++batch)
        objective.update(batch, TetUpdate::all, positions);
    std::size_t count = 0;
    for (std::size_t group = 0; group < objective.group_count(); ++group) {
        cpu::PlainTerms terms;
        objective.descend(group, false, positions, terms);  // in which held nodes stay
        for (std::uint32_t r = 0; r < cpu::kGroup; ++r) {
            const std::uint32_t node = objective.rows().nodes[group * cpu::kGroup + r];
            if (node == kNoNode) continue;
            const glm::dvec3& diagonal = terms.row(r).hessian.diagonal;
            const double expected = (diagonal.x + diagonal.y + diagonal.z) / 3.0;
            EXPECT_NEAR(static_cast<double>(surface.stiffness[node]), expected, 0.01 * expected);
            ++count;
        }
    }
    EXPECT_EQ(count, model->node_count());
}

TEST(NodeStiffness, IsThatOfTheElementsAtRest) {
    for (const double poisson_ratio : {0.25, 0.4}) {
        expect_trace_of_elements(MaterialModel::mass_spring, poisson_ratio);
        expect_trace_of_elements(MaterialModel::neo_hookean, poisson_ratio);
    }
}

}  // namespace
}  // namespace gelatin
