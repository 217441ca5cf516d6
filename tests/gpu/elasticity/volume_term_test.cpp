// The volume term of explicit steps on the GPU against the double reference, on bodies in motion whose tets
// are partly inside out, below and above 1/4, with pins, colliders, and neo-Hookean bodies beside.
#include "model/elasticity/volume_term.h"

#include <gtest/gtest.h>

#include "model/setting_names.h"
#include "support/descend_on_gpu.h"
#include "support/gl_fixture.h"
#include "support/parity.h"
#include "support/step_on_gpu.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kStep = 2e-4;  // [s]

struct Case {
    SolverKind solver;
    ForceMethod forces;
};

class VolumeTermOnGpuTest : public test::GlTest, public ::testing::WithParamInterface<Case> {};
INSTANTIATE_TEST_SUITE_P(All, VolumeTermOnGpuTest,
                         ::testing::Values(Case{SolverKind::semi_implicit_euler, ForceMethod::fused},
                                           Case{SolverKind::rk4, ForceMethod::fused},
                                           Case{SolverKind::semi_implicit_euler,
                                                ForceMethod::divide_and_merge},
                                           Case{SolverKind::rk4, ForceMethod::divide_and_merge}),
                         [](const auto& test) {
                             return std::string(name_of(test.param.solver)) +
                                    (test.param.forces == ForceMethod::fused ? "_fused"
                                                                             : "_divide_and_merge");
                         });

TEST_P(VolumeTermOnGpuTest, StepsMatchTheDoubleReference) {
    for (const MaterialModel most : {MaterialModel::mass_spring, MaterialModel::neo_hookean}) {
        for (const double poisson_ratio : {0.0, 0.45}) {
            Model model = test::make_bodies_to_descend(2e-3, poisson_ratio, most);
            for (glm::vec4& p : model.positions) p.x *= 1.02f;  // no body is at rest
            ASSERT_NE(model.node_count() % 64, 0u);
            ASSERT_FALSE(model.volume_term.is_empty());
            const test::NodeArrays actual =
                test::step_on_gpu(model, GetParam().solver, GetParam().forces, kStep);
            EXPECT_LE(test::worst_error(model, test::rounding_bounds(model, GetParam().solver, kStep),
                                        test::oracle_step(model, GetParam().solver, kStep), actual.positions,
                                        actual.velocities),
                      1.0)
                << poisson_ratio;
            EXPECT_TRUE(test::guard_is_untouched(actual.positions, model.node_count()));
            EXPECT_TRUE(test::guard_is_untouched(actual.velocities, model.node_count()));
        }
    }
}

}  // namespace
}  // namespace gelatin
