// Poisson's ratio in explicit solvers: a free bar of fitted springs, pulled by tractions at its ends and
// damped until it rests, is one of uniform stress, E = traction / strain. It must come to where statics says,
// which knows the volume term apart from them.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "cpu/explicit/explicit_solver.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "model/explicit/stability.h"
#include "support/test_models.h"
#include "verify/support/statics.h"

namespace gelatin::poissons_ratio_test {
namespace {

constexpr double kYoungsModulus = 2e5;        // [Pa]
constexpr double kTraction = 2e-3 * 2e5;      // [Pa]
constexpr glm::dvec3 kSize{0.25, 0.5, 0.25};  // [m]
constexpr int kAcross = 4;                    // edges
constexpr double kDamping = 0.008;            // [s]: 0.35 of critical for the lowest mode

Body make_bar(double poisson_ratio) {
    BoxShape box;
    box.size = kSize;
    box.segments = {kAcross, 2 * kAcross, kAcross};
    MesherSettings mesher;
    mesher.quality = 1.5;
    mesher.max_volume = 0.2 * std::pow(kSize.x / kAcross, 3);
    Material material;
    material.youngs_modulus = kYoungsModulus;
    material.poisson_ratio = poisson_ratio;
    material.damping = kDamping;
    Body bar = test::make_body(tetrahedralise(make_box(box), mesher, "bar"), material);
    const double end = -0.5 * kSize.y + 1e-4;
    bar.loads = {{HalfSpaceRegion{{0.0, 1.0, 0.0}, end}, TractionLoad{{0.0, -kTraction, 0.0}}},
                 {HalfSpaceRegion{{0.0, -1.0, 0.0}, end}, TractionLoad{{0.0, kTraction, 0.0}}}};
    return bar;
}

struct Answer {
    double modulus;  // over the one asked for
    double poisson_ratio;
};

// @param along, sideways mean strains
Answer answer_of(double along, double sideways) {
    return {kTraction / kYoungsModulus / along, -sideways / along};
}

Answer at_rest(const Model& model) {
    test::Statics statics(model);
    for (const LoadedNode& loaded : model.loads.nodes) {
        for (std::uint32_t e = loaded.first; e < loaded.end; ++e)
            statics.pull(loaded.node, {0.0, static_cast<double>(model.loads.entries[e].force.y), 0.0});
    }
    statics.solve();
    const Eigen::Matrix3d strain = statics.mean_strain();
    return answer_of(strain(1, 1), 0.5 * (strain(0, 0) + strain(2, 2)));
}

// Mean strains by Gauss, from what the boundary has moved.
Answer after_relaxing(const Model& model, SolverKind kind) {
    cpu::ExplicitSolver<float> solver(std::make_shared<const Model>(model), kind, ForceMethod::fused);
    const double step = 0.8 * largest_stable_step(kind, model);
    const int steps = static_cast<int>(0.35 / step);
    for (int s = 0; s < steps; ++s) solver.advance({step});
    const State state = solver.read_state();
    glm::dvec3 strain(0.0);
    for (const Face& face : model.faces) {
        const glm::dvec3 a(model.positions[face.a]), b(model.positions[face.b]), c(model.positions[face.c]);
        glm::dvec3 moved(0.0);
        for (const std::uint32_t n : {face.a, face.b, face.c})
            moved += glm::dvec3(state.positions[n]) - glm::dvec3(model.positions[n]);
        strain += glm::cross(b - a, c - a) * moved / 6.0;
    }
    strain /= model.objects[0].rest_volume;
    return answer_of(strain.y, 0.5 * (strain.x + strain.z));
}

TEST(PoissonsRatioHeavy, IsWhatWasAskedForInExplicitSolversToo) {
    for (const double poisson_ratio : {0.0, 0.25, 0.4, 0.45}) {
        SCOPED_TRACE(poisson_ratio);
        const Model model = test::make_model(make_bar(poisson_ratio));
        const Answer expected = at_rest(model);
        const Answer actual = after_relaxing(model, SolverKind::semi_implicit_euler);
        RecordProperty(fmt::format("nu_{}", poisson_ratio),
                       fmt::format("{:.3f} {:.3f}", actual.modulus, actual.poisson_ratio));
        EXPECT_NEAR(actual.modulus, expected.modulus, 5e-3);
        EXPECT_NEAR(actual.poisson_ratio, expected.poisson_ratio, 5e-3);
        // What a negative kappa takes away is felt at the surface of a coarse mesh.
        const double bound = poisson_ratio < 0.25 ? 0.08 : 0.02;
        EXPECT_NEAR(actual.modulus, 1.0, bound);
        EXPECT_NEAR(actual.poisson_ratio, poisson_ratio, bound);
    }
}

}  // namespace
}  // namespace gelatin::poissons_ratio_test
