#include "cpu/measure/measure.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "support/draw_vector.h"
#include "support/implicit_euler.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

template <class Real>
cpu::Nodes<Real> start_of(const Model& model) {
    return {{model.positions.begin(), model.positions.end()},
            {model.velocities.begin(), model.velocities.end()}};
}

TEST(Measure, AgreesWithClosedFormsForABlockInFlight) {
    Material material;
    material.density = 500.0;
    Body body = test::make_body(test::make_block({3, 3, 3}, {2.0, 1.0, 1.0}, 0.2), material);
    body.velocity = {3.0, 0.0, -4.0};
    const Model model = test::make_model(body, {0.0, -10.0, 0.0});
    const ObjectMeasure sums = cpu::measure(model, start_of<double>(model))[0];
    EXPECT_NEAR(sums.volume, 2.0, 1e-6);
    EXPECT_NEAR(sums.momentum.x, 3000.0, 1e-2);
    EXPECT_NEAR(sums.momentum.z, -4000.0, 1e-2);
    EXPECT_NEAR(sums.kinetic_energy, 0.5 * 1000.0 * 25.0, 1e-1);
    EXPECT_NEAR(sums.elastic_energy, 0.0, 1e-6);
    EXPECT_NEAR(sums.potential_energy, 1000.0 * 10.0 * 0.5, 1e1)
        << "the centre is at a height of 1/2, up to jitter";
    EXPECT_EQ(sums.contacts, 0u);
}

TEST(Measure, StretchedSpringHoldsHalfKTimesItsSquare) {
    const Model model = test::make_model(test::make_oscillator(200.0, 1.0, 0.1));
    EXPECT_NEAR(cpu::measure(model, start_of<double>(model))[0].elastic_energy, 0.5 * 200.0 * 0.01, 1e-6);
}

// Against the energy of the Newton reference, written apart from it: at rest nothing, and shaken until tets
// are inside out.
TEST(Measure, ElasticEnergyHasTheVolumeTerm) {
    constexpr MaterialModel kSprings = MaterialModel::mass_spring, kTets = MaterialModel::neo_hookean;
    for (const auto& [material_model, poisson_ratio] :
         {std::pair(kSprings, 0.0), {kSprings, 0.1}, {kSprings, 0.4}, {kSprings, 0.49}, {kTets, 0.4}}) {
        SCOPED_TRACE(poisson_ratio);
        Material material = test::structural_material();
        material.model = material_model;
        material.poisson_ratio = poisson_ratio;
        Model model =
            test::make_model(test::make_body(test::make_block({3, 4, 3}, {0.3, 0.4, 0.3}, 0.2), material));
        const auto energy = [&] { return cpu::measure(model, start_of<double>(model))[0].elastic_energy; };
        const double scale = 0.036 * material.youngs_modulus;
        EXPECT_LT(std::abs(energy()), 1e-10 * scale);
        std::mt19937 random(3);
        std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
        for (const float size : {1e-3f, 0.02f, 0.06f}) {
            for (glm::vec4& p : model.positions)
                p += size * glm::vec4(test::draw_vector<glm::vec3>(unit, random), 0.0f);
            // At rest there, so that inertia has no part in the objective.
            const test::ImplicitEuler reference(model, 1.0);
            const double expected = reference.value(reference.start());
            EXPECT_NEAR(energy() / expected, 1.0, 1e-9);
            model.volume_term = {};
            EXPECT_GT(std::abs(energy() / expected - 1.0), 0.005) << "without it";
            model.volume_term =
                make_volume_term(model.tets, model.tet_rests, make_node_tets(model.node_count(), model.tets));
        }
    }
}

TEST(Measure, CountsNodesOnAColliderAndTheDeepest) {
    Body body = test::make_body(test::make_block({2, 2, 2}, {1, 1, 1}));
    for (glm::dvec3& p : body.mesh.positions) p.y -= 0.25;
    const Model model = pack_bodies({body}, {ColliderDescription{}}, {});
    const ObjectMeasure sums = cpu::measure(model, start_of<float>(model))[0];
    EXPECT_EQ(sums.contacts, 9u);
    EXPECT_NEAR(sums.deepest_penetration, 0.25, 1e-7);
}

TEST(Measure, GivesTheSameBitsForAnyNumberOfThreads) {
    const Model model = test::make_lively_model();
    const auto run = [&](std::size_t threads) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return cpu::measure(model, start_of<float>(model))[0];
    };
    const ObjectMeasure one = run(1), two = run(2);
    EXPECT_EQ(one.kinetic_energy, two.kinetic_energy);
    EXPECT_EQ(one.elastic_energy, two.elastic_energy);
    EXPECT_EQ(one.volume, two.volume);
}

}  // namespace
}  // namespace gelatin
