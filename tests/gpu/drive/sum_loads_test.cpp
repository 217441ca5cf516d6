#include "gpu/drive/sum_loads.h"

#include <gtest/gtest.h>

#include "support/drive_on_gpu.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class SumLoadsOnGpuTest : public test::GlTest {};

TEST_F(SumLoadsOnGpuTest, MatchesTheDoubleReference) {
    const Model model = test::make_driven_model();
    ASSERT_NE(model.loads.nodes.size() % 64, 0u);
    for (const std::vector<float>& factors :
         {std::vector<float>{1.0f, 1.0f, 1.0f, 1.0f}, {0.3f, 0.0f, 0.7f, 1.0f}, {0.0f, 0.0f, 0.0f, 0.0f}})
        EXPECT_LE(test::worst_load_error(model, factors, test::sum_loads_on_gpu(model, factors)), 1.0);
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
