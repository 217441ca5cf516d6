#include "gpu/explicit/divide_and_merge.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "cpu/explicit/advance_nodes.h"
#include "support/gl_fixture.h"
#include "support/parity.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class DivideAndMergeTest : public test::GlTest {};

// The merged force of each node against the double reference: |error| <= 8 eps (valence + 4) sum k (X + ...)
// as in test::rounding_bounds, without the mass.
TEST_F(DivideAndMergeTest, MergedForcesMatchTheCpuReference) {
    const Model model = test::make_lively_model();
    const ExplicitScheme& scheme = explicit_scheme(SolverKind::semi_implicit_euler);
    const gpu::DivideAndMerge stage(model, scheme);
    stage.write_spring_forces({model.positions, model.velocities});
    stage.merge_spring_forces();
    gl::barrier(gl::Barrier::buffer_update);
    std::vector<glm::vec4> actual = test::poisoned(0);
    actual.resize(model.node_count());
    stage.node_forces().download(actual);

    cpu::Nodes<double> nodes{{model.positions.begin(), model.positions.end()},
                             {model.velocities.begin(), model.velocities.end()}};
    cpu::Nodes<double> out = nodes, none;
    std::vector<glm::dvec4> spring_forces(model.springs.size()), expected(model.node_count());
    const auto pass = cpu::make_pass(model, scheme, 0, 1.0, nodes, nodes, out, none);
    cpu::write_spring_forces<double>(pass, spring_forces,
                                     {0, static_cast<std::uint32_t>(model.springs.size())});
    cpu::merge_spring_forces<double>(model, spring_forces, expected, {0, model.node_count()});

    const test::StepBounds bounds = test::rounding_bounds(model, SolverKind::semi_implicit_euler, 1.0);
    double largest = 0.0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        largest = std::max(largest, glm::length(expected[n]));
        if (model.positions[n].w == 0.0f) continue;
        const double bound = bounds.velocity[n] / static_cast<double>(model.positions[n].w);
        EXPECT_LE(glm::distance(glm::dvec3(actual[n]), glm::dvec3(expected[n])), bound);
    }
    EXPECT_GT(largest, 1.0) << "nothing to compare";
}

}  // namespace
}  // namespace gelatin
