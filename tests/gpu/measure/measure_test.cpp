#include "gpu/measure/measure.h"

#include <gtest/gtest.h>

#include "cpu/measure/measure.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class MeasureOnGpuTest : public test::GlTest {};

// Sums of n terms in float, in chunks of 256 over 64 lanes: relative error below (4 + 64) eps of the absolute
// sum.
constexpr double kRelative = 70.0 * 1.2e-7;

TEST_F(MeasureOnGpuTest, MatchesTheDoubleReference) {
    Body small = test::make_body(test::make_block({2, 3, 2}, {0.5, 0.5, 0.5}));
    for (glm::dvec3& p : small.mesh.positions) p += glm::dvec3(3.0, -0.1, 0.0);
    small.velocity = {0.0, 2.0, 1.0};
    Body large = test::make_body(test::make_block({9, 10, 10}, {0.9, 1.0, 1.0}, 0.2));
    large.velocity = {1.0, 0.5, -2.0};
    Model model = pack_bodies({large, small}, {ColliderDescription{}}, {0.0, -9.81, 0.0});
    for (glm::vec4& p : model.positions) p.x *= 1.02f;

    gpu::Measure stage(model);
    const gpu::ModelBuffers buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    stage.begin(buffers, nodes);
    const std::vector<ObjectMeasure> actual = stage.end().objects;
    const std::vector<ObjectMeasure> expected =
        cpu::measure<double>(model, {{model.positions.begin(), model.positions.end()},
                                     {model.velocities.begin(), model.velocities.end()}});
    ASSERT_EQ(actual.size(), 2u);
    for (std::size_t o = 0; o < 2; ++o) {
        const double speed_scale = model.objects[o].mass * 3.0;
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(actual[o].momentum[k], expected[o].momentum[k], kRelative * speed_scale);
        }
        EXPECT_NEAR(actual[o].kinetic_energy / expected[o].kinetic_energy, 1.0, kRelative);
        EXPECT_NEAR(actual[o].potential_energy, expected[o].potential_energy,
                    kRelative * model.objects[o].mass * 10.0);
        // A stretch of 2% is the difference of lengths that carry rounding at coordinates of a few metres.
        EXPECT_NEAR(actual[o].elastic_energy / expected[o].elastic_energy, 1.0, 1e-3);
        EXPECT_GT(expected[o].elastic_energy, 0.0);
        EXPECT_NEAR(actual[o].volume / expected[o].volume, 1.0, 20 * kRelative);
        EXPECT_EQ(actual[o].contacts, expected[o].contacts);
        EXPECT_NEAR(actual[o].deepest_penetration, expected[o].deepest_penetration, 1e-6);
    }
    EXPECT_GT(actual[1].contacts, 0u);
}

TEST_F(MeasureOnGpuTest, AnswersInOrderWithTwoUnderWay) {
    Model model = test::make_model(test::make_body(test::make_block({2, 2, 2}, {1, 1, 1})));
    gpu::Measure stage(model);
    const gpu::ModelBuffers buffers(model);
    const gpu::NodeBuffers first(model.positions, model.velocities);
    for (glm::vec4& p : model.positions) p.x *= 2.0f;
    const gpu::NodeBuffers second(model.positions, model.velocities);
    stage.begin(buffers, first);
    stage.begin(buffers, second);
    EXPECT_NEAR(stage.end().objects[0].volume, 1.0, 1e-5);
    EXPECT_NEAR(stage.end().objects[0].volume, 2.0, 1e-5);
}

}  // namespace
}  // namespace gelatin
