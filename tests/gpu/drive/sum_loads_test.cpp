#include "gpu/drive/sum_loads.h"

#include <gtest/gtest.h>

#include "gpu/support/drive_on_gpu.h"
#include "gpu/support/solver_scenarios.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class LoadParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, LoadParityTest, ::testing::ValuesIn(test::load_scenarios()),
                         test::name_of_scenario);

TEST_P(LoadParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class SumLoadsOnGpuTest : public test::GlTest {};

TEST_F(SumLoadsOnGpuTest, HasNodesBeyondTheLastFullGroup) {
    EXPECT_NE(test::make_driven_model().loads.nodes.size() % 64, 0u);
}

// A load that ends leaves nothing behind.
TEST_F(SumLoadsOnGpuTest, FactorsCanChange) {
    const Model model = test::make_driven_model();
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    gpu::SumLoads loads(model);
    loads.run(nodes);
    for (const std::vector<float>& factors :
         {std::vector<float>{0.0f, 1.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f, 0.0f}}) {
        loads.set_factors(factors);
        loads.run(nodes);
        gl::barrier(gl::Barrier::buffer_update);
        std::vector<glm::vec4> forces(model.positions.size());
        loads.forces().download(forces);
        EXPECT_LE(test::worst_load_error(model, factors, forces), 1.0);
    }
}

}  // namespace
}  // namespace gelatin
