// A bar that hangs under its own weight lengthens by rho g L^2 / (2 E) (Hooke's law with a stress that grows
// linearly from the free end). Fitted springs respond like that. The paper's are softer, because nodes inside
// leave the affine positions (docs/springs.md). How much is recorded here, so that no change goes unnoticed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "cpu/explicit/explicit_solver.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "model/explicit/stability.h"
#include "support/test_models.h"

namespace gelatin::hanging_bar_test {
namespace {

constexpr double kLength = 1.0, kWidth = 0.25;  // [m]
constexpr double kYoungsModulus = 1e6;          // [Pa]
constexpr double kDensity = 1000.0;             // [kg/m^3]
constexpr double kGravity = 9.81;               // [m/s^2]

constexpr SpringKinds kStructural{true, false, false}, kWithShear{true, true, false}, kAll{true, true, true};

// The measured E relative to the requested one.
double answered_modulus(int edges_across, const std::optional<SpringKinds>& springs) {
    BoxShape box;
    box.size = {kWidth, kLength, kWidth};
    box.segments = {edges_across, 4 * edges_across, edges_across};
    MesherSettings mesher;
    mesher.quality = 1.5;
    mesher.max_volume = 0.2 * std::pow(kWidth / edges_across, 3);
    Body body = test::make_body(tetrahedralise(make_box(box), mesher, "bar"));
    body.material.youngs_modulus = kYoungsModulus;
    body.material.density = kDensity;
    body.material.damping = 4e-3;
    body.material.springs = springs;
    body.pins = {HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.4999 * kLength}};
    const auto model = std::make_shared<const Model>(test::make_model(body, {0.0, -kGravity, 0.0}));

    cpu::ExplicitSolver<float> solver(model, SolverKind::semi_implicit_euler, ForceMethod::fused);
    const double step = 0.8 * largest_stable_step(SolverKind::semi_implicit_euler, *model);
    for (double time = 0.0; time < 1.5; time += step)
        solver.advance({step});  // twelve periods, ten time constants
    double sag = 0.0;
    int count = 0;
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        if (model->positions[n].y > -0.4999f * static_cast<float>(kLength)) continue;
        sag += static_cast<double>(model->positions[n].y - solver.nodes().positions[n].y);
        ++count;
    }
    return kDensity * kGravity * kLength * kLength / (2.0 * kYoungsModulus) / (sag / count);
}

struct Case {
    const char* name;
    std::optional<SpringKinds> springs;  // empty: fitted
    int edges_across;
    double recorded;
};

class HangingBarTest : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Recorded, HangingBarTest,
                         ::testing::Values(Case{"structural_2", kStructural, 2, 0.694},
                                           Case{"structural_4", kStructural, 4, 0.770},
                                           Case{"with_shear_2", kWithShear, 2, 0.808},
                                           Case{"with_shear_4", kWithShear, 4, 0.858},
                                           Case{"with_shear_and_flex_2", kAll, 2, 0.870},
                                           Case{"fitted_2", std::nullopt, 2, 1.003},
                                           Case{"fitted_4", std::nullopt, 4, 1.010}),
                         [](const auto& test) { return test.param.name; });

TEST_P(HangingBarTest, AnswersAsRecorded) {
    const double answered = answered_modulus(GetParam().edges_across, GetParam().springs);
    EXPECT_NEAR(answered, GetParam().recorded, 0.02);
}

class HangingBarLong : public HangingBarTest {};
INSTANTIATE_TEST_SUITE_P(Recorded, HangingBarLong,
                         ::testing::Values(Case{"structural_6", kStructural, 6, 0.843},
                                           Case{"with_shear_6", kWithShear, 6, 0.906},
                                           Case{"with_shear_and_flex_4", kAll, 4, 0.858},
                                           Case{"with_shear_and_flex_6", kAll, 6, 0.918},
                                           Case{"fitted_6", std::nullopt, 6, 1.012}),
                         [](const auto& test) { return test.param.name; });

TEST_P(HangingBarLong, AnswersAsRecorded) {
    const double answered = answered_modulus(GetParam().edges_across, GetParam().springs);
    EXPECT_NEAR(answered, GetParam().recorded, 0.02);
}

}  // namespace
}  // namespace gelatin::hanging_bar_test
