// Vertex block descent comes to the step of implicit Euler that Newton's method finds.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "cpu/descent/block_descent.h"
#include "support/implicit_euler.h"
#include "support/test_models.h"

namespace gelatin::block_descent_test {
namespace {

constexpr double kFrame = 1.0 / 60.0;  // [s]

// An irregular bar, held at one end, its free end struck from below.
Model struck_bar(double youngs_modulus, double poisson_ratio, glm::ivec3 cells = {8, 3, 3},
                 MaterialModel model_of_material = MaterialModel::mass_spring) {
    Body body = test::make_body(test::make_block(cells, 0.05 * glm::dvec3(cells), 0.2));
    body.material.model = model_of_material;
    body.material.youngs_modulus = youngs_modulus;
    body.material.poisson_ratio = poisson_ratio;
    body.pins = {HalfSpaceRegion{{1, 0, 0}, 1e-6}};
    Model model = pack_bodies({body}, {}, {0.0, -9.81, 0.0});
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const glm::vec4& p = model.positions[n];
        if (p.w > 0.0f) model.velocities[n].y = 5.0f * p.x * p.x;
    }
    return model;
}

Eigen::VectorXd descend(const Model& model, const DescentSettings& settings) {
    const cpu::Nodes<double> start{{model.positions.begin(), model.positions.end()},
                                   {model.velocities.begin(), model.velocities.end()}};
    cpu::Nodes<double> end = start;
    cpu::BlockDescent<double>(std::make_shared<const Model>(model), settings).run(kFrame, false, start, end);
    Eigen::VectorXd x(3 * static_cast<Eigen::Index>(model.node_count()));
    for (Eigen::Index n = 0; n < x.size() / 3; ++n) {
        const glm::dvec4& p = end.positions[static_cast<std::size_t>(n)];
        x.segment<3>(3 * n) = Eigen::Vector3d(p.x, p.y, p.z);
    }
    return x;
}

class ConvergenceHeavy : public ::testing::TestWithParam<std::tuple<MaterialModel, double, double>> {};
INSTANTIATE_TEST_SUITE_P(Springs, ConvergenceHeavy,
                         ::testing::Combine(::testing::Values(MaterialModel::mass_spring),
                                            ::testing::Values(1e4, 1e6), ::testing::Values(0.1, 0.25, 0.4)));
INSTANTIATE_TEST_SUITE_P(Tets, ConvergenceHeavy,
                         ::testing::Combine(::testing::Values(MaterialModel::neo_hookean),
                                            ::testing::Values(1e4, 1e6),
                                            ::testing::Values(0.25, 0.45, 0.49)));

TEST_P(ConvergenceHeavy, IsToNewtonsSolution) {
    const auto [model_of_material, youngs_modulus, poisson_ratio] = GetParam();
    const Model model = struck_bar(youngs_modulus, poisson_ratio, {8, 3, 3}, model_of_material);
    const test::ImplicitEuler objective(model, kFrame);
    const Eigen::VectorXd exact = objective.minimum();
    const double displacement = (exact - objective.start()).norm();
    // Tets' shapes at rest are in single precision, and the volume term has them twice.
    const double floor = model_of_material == MaterialModel::neo_hookean ? 1e-6 : 1e-11;
    double last = 1.0;
    for (const int iterations : {3, 10, 30, 100, 300, 1000}) {
        const Eigen::VectorXd x = descend(model, {iterations});
        const double error = (x - exact).norm() / displacement;
        RecordProperty("error_" + std::to_string(iterations), fmt::format("{:.2e}", error));
        EXPECT_LT(error, std::max(last, floor)) << iterations << " sweeps";
        last = error;
    }
    EXPECT_LT(last, 1e-5);
}

TEST(CoarseLevel, BringsLongStiffBodiesNearWithFewSweeps) {
    const Model model = struck_bar(1e6, 0.25);
    const test::ImplicitEuler objective(model, kFrame);
    const Eigen::VectorXd exact = objective.minimum();
    const double displacement = (exact - objective.start()).norm();
    EXPECT_LT((descend(model, {10}) - exact).norm() / displacement, 0.05);
    EXPECT_GT((descend(model, {10, false}) - exact).norm() / displacement, 0.25);
}

}  // namespace
}  // namespace gelatin::block_descent_test
