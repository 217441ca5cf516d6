#include <gtest/gtest.h>

#include "model/setting_names.h"
#include "support/descend_on_gpu.h"
#include "support/gl_fixture.h"
#include "support/pull_on_gpu.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class PullsOnGpuTest : public test::GlTest {};

// Beside loads, and without.
TEST_F(PullsOnGpuTest, MatchTheDoubleReferenceInExplicitSchemes) {
    for (const Model& model : {test::make_driven_model(), test::make_lively_model()}) {
        for (const SolverKind kind : {SolverKind::explicit_euler, SolverKind::semi_implicit_euler,
                                      SolverKind::midpoint, SolverKind::rk4}) {
            for (const ForceMethod forces : {ForceMethod::fused, ForceMethod::divide_and_merge})
                EXPECT_LE(test::worst_pull_error(model, kind, forces, 2e-4), 1.0) << name_of(kind);
        }
    }
}

TEST_F(PullsOnGpuTest, MatchTheDoubleReferenceInBlockDescent) {
    for (const bool driven : {false, true}) {
        const Model model = test::make_bodies_to_descend(0.01, 0.25, MaterialModel::mass_spring, driven);
        EXPECT_LE(test::worst_pull_error(model, SolverKind::vbd, ForceMethod::fused, 1.0 / 60.0), 1.0);
    }
}

}  // namespace
}  // namespace gelatin
