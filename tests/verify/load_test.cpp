// Loads against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/implicit/system_solver.h"
#include "cpu/make_solver.h"
#include "gpu/make_solver.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "model/explicit/stability.h"
#include "model/setting_names.h"
#include "support/gl_fixture.h"
#include "support/solver_kinds.h"
#include "support/test_models.h"

namespace gelatin::load_test {
namespace {

const Region kEverywhere = HalfSpaceRegion{{1.0, 0.0, 0.0}, 100.0};

glm::dvec3 mean_velocity(const Model& model, const State& state) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        sum += static_cast<double>(model.masses[n]) * glm::dvec3(state.velocities[n]);
    return sum / model.objects[0].mass;
}

// A force on a part of a free body accelerates its centre by F / m, however the body deforms.
template <class MakeSolver>
void expect_newtons_second_law(const MakeSolver& make_solver, double tolerance) {
    Body block = test::make_body(test::make_block({4, 3, 3}, {0.4, 0.3, 0.3}, 0.2));
    const glm::dvec3 force(3.0, 40.0, -20.0);
    block.loads = {{HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.11}, ForceLoad{force}}};
    const auto model = std::make_shared<const Model>(test::make_model(block, {0.0, -9.81, 0.0}));
    for (const SolverKind kind : test::kSolvers) {
        const double step = std::min(0.01, 0.5 * largest_stable_step(kind, *model));
        const std::unique_ptr<Solver> solver = make_solver(model, kind);
        for (int s = 0; s < 50; ++s) solver->advance({step});
        const glm::dvec3 expected =
            50.0 * step * (force / model->objects[0].mass + glm::dvec3(0.0, -9.81, 0.0));
        EXPECT_LT(glm::distance(mean_velocity(*model, solver->read_state()), expected),
                  tolerance * glm::length(expected))
            << name_of(kind);
    }
}

TEST(Load, AForceAcceleratesAFreeBody) {
    expect_newtons_second_law(
        [](const auto& model, SolverKind kind) {
            return cpu::make_solver<double>(model, kind, ForceMethod::fused);
        },
        1e-6);
    expect_newtons_second_law(
        [](const auto& model, SolverKind kind) {
            return cpu::make_solver<float>(model, kind, ForceMethod::divide_and_merge);
        },
        1e-3);
}

class LoadOnGpuTest : public test::GlTest {};
TEST_F(LoadOnGpuTest, AForceAcceleratesAFreeBody) {
    expect_newtons_second_law(
        [](const auto& model, SolverKind kind) { return gpu::make_solver(model, kind, ForceMethod::fused); },
        1e-3);
}

// Held at one end and pulled at the other by F, a bar gets longer by F L / (E A): here by 2%, where it comes
// to rest by implicit steps, by F and by the stress F / A alike.
TEST(LoadHeavy, ABarGetsLongerByHookesLaw) {
    constexpr double kLength = 0.4, kSide = 0.1, kModulus = 1e5, kStrain = 0.02;
    const double stress = kStrain * kModulus, force = stress * kSide * kSide;
    const Region end = HalfSpaceRegion{{-1.0, 0.0, 0.0}, -0.4999 * kLength};
    MesherSettings mesher;
    mesher.max_volume = 1e-5;
    const TetMesh mesh = tetrahedralise(make_box({{kLength, kSide, kSide}, {16, 4, 4}}), mesher, "bar");
    Material rubber;
    rubber.youngs_modulus = kModulus;
    rubber.damping = 0.01;
    for (const LoadDescription& load : {LoadDescription{end, ForceLoad{{force, 0.0, 0.0}}},
                                        LoadDescription{end, TractionLoad{{stress, 0.0, 0.0}}},
                                        LoadDescription{end, PressureLoad{-stress}}}) {
        Body bar = test::make_body(mesh, rubber);
        bar.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, -0.4999 * kLength}};
        bar.loads = {load};
        const auto model = std::make_shared<const Model>(test::make_model(bar));
        cpu::SystemSolver<float> solver(model, {}, {40});
        for (int s = 0; s < 800; ++s) solver.advance({2e-3});
        double longer = 0.0, mass = 0.0, speed = 0.0;
        for (const LoadedNode& loaded : model->loads.nodes) {
            const std::uint32_t n = loaded.node;
            const auto m = static_cast<double>(model->masses[n]);
            longer += m * (solver.nodes().positions[n].x - model->positions[n].x);
            speed += m * solver.nodes().velocities[n].x;
            mass += m;
        }
        EXPECT_LT(std::abs(speed / mass), 1e-4) << "at rest";
        EXPECT_NEAR(longer / mass / (force * kLength / (kModulus * kSide * kSide)), 1.0, 0.05);
    }
}

// Under a pressure p a body of bulk modulus K = E / (3 (1 - 2 nu)), with nu = 1/4, loses p / K of its volume.
TEST(Load, APressureCompressesABall) {
    const double modulus = 1e5, pressure = 0.02 * modulus / 1.5;
    MesherSettings mesher;
    Material rubber;
    rubber.youngs_modulus = modulus;
    Body ball = test::make_body(tetrahedralise(make_sphere({0.2, 5}), mesher, "ball"), rubber);
    ball.loads = {{kEverywhere, PressureLoad{pressure}}};
    const auto model = std::make_shared<const Model>(test::make_model(ball));
    cpu::SystemSolver<float> solver(model, {}, {20});
    for (int s = 0; s < 120; ++s) solver.advance({1.0 / 60.0});
    solver.begin_measure();
    const ObjectMeasure sums = solver.end_measure().objects[0];
    EXPECT_NEAR((1.0 - sums.volume / model->objects[0].rest_volume) / 0.02, 1.0, 0.05);
    EXPECT_LT(glm::length(sums.momentum), 1e-5 * model->objects[0].mass) << "a closed surface is not pushed";
}

}  // namespace
}  // namespace gelatin::load_test
