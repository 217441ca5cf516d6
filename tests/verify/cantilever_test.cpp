// A cantilever of 0.02 x 0.02 x 0.2 m, 1,100 kg/m^3, 2 MPa, under its own weight: where its tip comes to
// rest, and how fast it swings without gravity, by refinement. Linear tets are too stiff in bending, and a
// little more so the less they can be compressed, for volumes are averaged over nodes; how much is recorded.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "support/test_models.h"
#include "verify/support/equilibrium.h"

namespace gelatin::cantilever_test {
namespace {

constexpr double kLength = 0.2, kWidth = 0.02;  // [m]
constexpr double kDensity = 1100.0;             // [kg/m^3]
constexpr double kYoungsModulus = 2e6;          // [Pa]
constexpr double kGravity = 9.81;               // [m/s^2]
constexpr double kArea = kWidth * kWidth;
constexpr double kMoment = kArea * kArea / 12.0;  // second, of the area [m^4]

// The elastica under its own weight w a metre: E I theta'' = -w (L - s) cos theta, theta(0) = 0, theta'(L) =
// 0, by shooting with Runge-Kutta steps. Returns how far the tip comes down [m].
double elastica_tip() {
    constexpr int kSteps = 2000;
    const double load = kDensity * kArea * kGravity / (kYoungsModulus * kMoment), h = kLength / kSteps;
    struct State {
        double angle, curvature, down;
    };
    const auto shoot = [&](double curvature) {
        const auto rate = [&](const State& y, double s) {
            return State{y.curvature, -load * (kLength - s) * std::cos(y.angle), std::sin(y.angle)};
        };
        const auto moved = [](const State& y, const State& r, double by) {
            return State{y.angle + by * r.angle, y.curvature + by * r.curvature, y.down + by * r.down};
        };
        State y{0.0, curvature, 0.0};
        for (int k = 0; k < kSteps; ++k) {
            const double s = k * h;
            const State a = rate(y, s), b = rate(moved(y, a, h / 2), s + h / 2),
                        c = rate(moved(y, b, h / 2), s + h / 2), d = rate(moved(y, c, h), s + h);
            y = moved(moved(moved(moved(y, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
        }
        return y;
    };
    double low = 0.0, high = load * kLength * kLength;  // of the clamped end's curvature
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (shoot(middle).curvature < 0.0 ? low : high) = middle;
    }
    return shoot(low).down;
}

// What shear adds (Timoshenko, shear coefficient 5/6) [m].
double shear_sag(double poisson_ratio) {
    const double shear_modulus = kYoungsModulus / (2 * (1 + poisson_ratio));
    return kDensity * kGravity * kLength * kLength / (2.0 * 5.0 / 6.0 * shear_modulus);
}

// Of the beam without shear and rotary inertia: 1.8751^2 / (2 pi L^2) sqrt(E I / rho A) [Hz].
double beam_frequency() {
    return 1.8751 * 1.8751 / (2 * std::numbers::pi * kLength * kLength) *
           std::sqrt(kYoungsModulus * kMoment / (kDensity * kArea));
}

TEST(CantileverReference, IsThatOfTheBooks) {
    const double straight =
        kDensity * kArea * kGravity * std::pow(kLength, 4) / (8 * kYoungsModulus * kMoment);
    EXPECT_NEAR(straight, 0.0324, 1e-4);  // Euler and Bernoulli, as if small
    EXPECT_NEAR(shear_sag(0.45), 0.37e-3, 0.02e-3);
    EXPECT_NEAR(beam_frequency(), 3.44, 0.01);
    EXPECT_LT(elastica_tip(), straight);
    EXPECT_GT(elastica_tip(), 0.95 * straight);
}

struct Beam {
    const char* name;
    MaterialModel model;
    double poisson_ratio;
    int edges_across;
    double recorded_tip;        // over the elastica's and the shear's
    double recorded_frequency;  // over the beam's
};

class Cantilever : public ::testing::TestWithParam<Beam> {
protected:
    void measure() const {
        const Beam& beam = GetParam();
        BoxShape box;
        box.size = {kLength, kWidth, kWidth};
        box.segments = {10 * beam.edges_across, beam.edges_across, beam.edges_across};
        MesherSettings mesher;
        mesher.quality = 1.5;
        mesher.max_volume = 0.2 * std::pow(kWidth / beam.edges_across, 3);
        Material material;
        material.model = beam.model;
        material.youngs_modulus = kYoungsModulus;
        material.poisson_ratio = beam.poisson_ratio;
        material.density = kDensity;
        Body body = test::make_body(tetrahedralise(make_box(box), mesher, "beam"), material);
        body.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, -0.4999 * kLength}};
        const Model model = test::make_model(body, {0.0, -kGravity, 0.0});

        test::Equilibrium statics(model);
        const double frequency = statics.lowest_frequency();
        statics.pull_by_gravity();
        statics.solve();
        double sag = 0.0;
        int count = 0;
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            if (model.positions[n].x < 0.4999f * static_cast<float>(kLength)) continue;
            sag -= statics.displacement(n).y();
            ++count;
        }
        EXPECT_NEAR(sag / count / (elastica_tip() + shear_sag(beam.poisson_ratio)), beam.recorded_tip, 5e-3);
        EXPECT_NEAR(frequency / beam_frequency(), beam.recorded_frequency, 5e-3);
    }
};
class CantileverLong : public Cantilever {};

constexpr MaterialModel kSprings = MaterialModel::mass_spring, kTets = MaterialModel::neo_hookean;
INSTANTIATE_TEST_SUITE_P(Recorded, Cantilever,
                         ::testing::Values(Beam{"springs_2", kSprings, 0.25, 2, 0.796, 1.116},
                                           Beam{"springs_4", kSprings, 0.25, 4, 0.949, 1.019},
                                           Beam{"tets_25_2", kTets, 0.25, 2, 0.667, 1.221},
                                           Beam{"tets_25_4", kTets, 0.25, 4, 0.892, 1.052},
                                           Beam{"tets_40_2", kTets, 0.40, 2, 0.656, 1.228},
                                           Beam{"tets_45_2", kTets, 0.45, 2, 0.631, 1.251},
                                           Beam{"tets_49_2", kTets, 0.49, 2, 0.572, 1.314}),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Recorded, CantileverLong,
                         ::testing::Values(Beam{"springs_6", kSprings, 0.25, 6, 0.977, 1.006},
                                           Beam{"tets_25_6", kTets, 0.25, 6, 0.943, 1.023},
                                           Beam{"tets_40_4", kTets, 0.40, 4, 0.880, 1.059},
                                           Beam{"tets_40_6", kTets, 0.40, 6, 0.930, 1.030},
                                           Beam{"tets_45_4", kTets, 0.45, 4, 0.868, 1.066},
                                           Beam{"tets_45_6", kTets, 0.45, 6, 0.920, 1.035},
                                           Beam{"tets_49_4", kTets, 0.49, 4, 0.846, 1.080},
                                           Beam{"tets_49_6", kTets, 0.49, 6, 0.904, 1.044}),
                         [](const auto& test) { return test.param.name; });

TEST_P(Cantilever, BendsAndSwingsAsRecorded) {
    measure();
}
TEST_P(CantileverLong, BendsAndSwingsAsRecorded) {
    measure();
}

}  // namespace
}  // namespace gelatin::cantilever_test
