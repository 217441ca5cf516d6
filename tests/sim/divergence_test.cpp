#include "sim/divergence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "model/explicit/stability.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// The node that is nearest to a place.
std::uint32_t node_at(const Model& model, const glm::vec3& place) {
    const auto nearer = [&](const glm::vec4& a, const glm::vec4& b) {
        return glm::distance(glm::vec3(a), place) < glm::distance(glm::vec3(b), place);
    };
    return static_cast<std::uint32_t>(
        std::min_element(model.positions.begin(), model.positions.end(), nearer) - model.positions.begin());
}

TetMesh block() {
    return test::make_block({4, 4, 4}, {1, 1, 1});
}

TEST(LikelyCause, NamesAFlatTetAtTheNode) {
    TetMesh mesh = block();
    mesh.positions.emplace_back(0.5, 0.25, -1e-5);  // on the bottom
    const auto apex = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    const auto at = [&](double x, double y) {
        return static_cast<std::uint32_t>(
            std::find(mesh.positions.begin(), mesh.positions.end(), glm::dvec3(x, y, 0.0)) -
            mesh.positions.begin());
    };
    mesh.tets.emplace_back(at(0.25, 0.25), at(0.5, 0.5), at(0.75, 0.25), apex);
    const Model model = test::make_model(test::make_body(mesh));
    const double step = 0.5 * largest_stable_step(SolverKind::semi_implicit_euler, model, Deformation::any);
    EXPECT_THAT(likely_cause(model, {}, node_at(model, {0.5f, 0.25f, -1e-5f}), step),
                StartsWith("a tet at the node is nearly flat (its volume is 1e-05 of"));
    EXPECT_THAT(
        likely_cause(model, {}, node_at(model, {1, 1, 1}), step),
        AllOf(Not(HasSubstr("flat")), StartsWith("neither the mesh there nor the step size is unusual")));
}

TEST(LikelyCause, NamesSpringsThatAreOddlyStiff) {
    Model model = test::make_model(test::make_body(block()));
    const std::uint32_t node = node_at(model, {1, 1, 1});
    for (Spring& spring : model.springs)
        spring.stiffness *= spring.i == node || spring.j == node ? 1e4f : 1.0f;
    EXPECT_EQ(stiffest_node(model, model.objects[0]), node);
    EXPECT_THAT(likely_cause(model, {}, node, 1e-9),
                StartsWith("relative to its mass, the node's springs are "));
}

TEST(LikelyCause, NamesAStepThatIsTooLongForSomeShapes) {
    const Model model = test::make_model(test::make_body(block()));
    Scene scene;
    scene.simulation.solver = SolverKind::semi_implicit_euler;
    const SolverKind solver = scene.simulation.solver;
    const double rest = largest_stable_step(solver, model),
                 any = largest_stable_step(solver, model, Deformation::any);
    ASSERT_LT(any, 0.9 * rest);
    const std::string cause = likely_cause(model, scene, 7, 0.5 * (any + rest));
    EXPECT_THAT(cause, HasSubstr("is stable for the bodies' shapes at rest"));
    EXPECT_THAT(cause, HasSubstr("simulation.substeps = " +
                                 std::to_string(static_cast<int>(std::ceil(1.0 / 60.0 / any)))));
    EXPECT_THAT(likely_cause(model, scene, 7, 0.99 * any),
                StartsWith("neither the mesh there nor the step size is unusual"));
    scene.simulation.solver = SolverKind::implicit;
    EXPECT_THAT(likely_cause(model, scene, 7, 1.0),
                StartsWith("neither the mesh there nor the step size is unusual"));
}

}  // namespace
}  // namespace gelatin
