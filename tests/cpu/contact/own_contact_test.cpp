#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/implicit/system_solver.h"
#include "cpu/measure/measure.h"
#include "support/contact_scenes.h"
#include "support/overlaps.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

using test::Block;
using test::kFrame;
using test::make_blocks;
using test::make_solver;

// Both ends of a bar whose middle is pinned go at each other.
TEST(OwnContact, ABarThatFoldsDoesNotPassThroughItself) {
    for (const double speed : {3.0, 20.0}) {
        auto model = std::make_shared<Model>(
            *make_blocks({{.cells = {14, 2, 3}, .size = {1.4, 0.2, 0.3}, .youngs_modulus = 2e4}}));
        for (std::uint32_t n = 0; n < model->node_count(); ++n) {
            const glm::vec4& p = model->positions[n];
            if (std::abs(p.x - 0.7f) > 0.2f)
                model->velocities[n] = glm::vec4(0, float(speed) * std::abs(p.x - 0.7f), 0, 0);
            if (p.x > 0.7f) model->velocities[n].x = -float(speed);
            if (p.x < 0.7f) model->velocities[n].x = float(speed);
        }
        const std::shared_ptr<const Model> shared = model;
        cpu::SystemSolver<float> solver = make_solver<float>(shared);
        const ObjectMeasure start = cpu::measure(*shared, solver.nodes()).front();
        double energy = start.kinetic_energy;
        for (int frame = 0; frame < 60; ++frame) {
            solver.advance({kFrame});
            ASSERT_EQ(test::count_overlaps(*shared, solver.nodes().positions), 0u)
                << speed << " m/s, frame " << frame;
            const ObjectMeasure now = cpu::measure(*shared, solver.nodes()).front();
            EXPECT_LT(glm::length(now.momentum - start.momentum), 1e-4 * speed * shared->objects[0].mass);
            EXPECT_LT(now.kinetic_energy + now.elastic_energy, energy + 2e-3 * start.kinetic_energy);
            energy = now.kinetic_energy + now.elastic_energy;
        }
    }
}

TEST(OwnContact, GivesTheSameBitsForAnyNumberOfThreads) {
    const auto run = [](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        const auto model = make_blocks({{.velocity = {8, 0, 0}, .youngs_modulus = 1e4},
                                        {.place = {0.34, 0.1, 0.05}, .youngs_modulus = 1e4}});
        cpu::SystemSolver<float> solver = make_solver<float>(model);
        for (int frame = 0; frame < 20; ++frame) solver.advance({kFrame});
        return solver.nodes().positions;
    };
    EXPECT_EQ(run(1), run(4));
}

void fuzz_folds(unsigned first, int count) {
    for (unsigned seed = first; seed < first + static_cast<unsigned>(count); ++seed) {
        test::RandomMaker random(seed);
        std::vector<Block> blocks;
        const int bodies = random.integer(1, 2);
        for (int k = 0; k < bodies; ++k)
            blocks.push_back(
                {.place = {0, 0.5 * k, 0},
                 .velocity = random.point(5.0),
                 .cells = {random.integer(6, 14), random.integer(1, 2), random.integer(1, 3)},
                 .size = {random.uniform(0.6, 1.5), random.uniform(0.03, 0.2), random.uniform(0.1, 0.4)},
                 .youngs_modulus = std::pow(10.0, random.uniform(3.0, 7.0)),
                 .poisson_ratio = random.uniform(0.2, 0.45)});
        std::vector<ColliderDescription> floor;
        if (seed % 2 == 0) floor.push_back({.shape = PlaneCollider{{0.0, 1.0, 0.0}, -0.1}});
        auto model = std::make_shared<Model>(*make_blocks(blocks, {0, -9.81, 0}, floor));
        const double speed = std::pow(10.0, random.uniform(0.0, 1.8));
        const double wave = random.uniform(2.0, 12.0);
        for (std::uint32_t n = 0; n < model->node_count(); ++n) {
            const glm::vec4& p = model->positions[n];
            const double phase = wave * static_cast<double>(p.x);
            model->velocities[n] +=
                glm::vec4(float(speed * std::cos(phase)), float(speed * std::sin(1.3 * phase)),
                          float(0.3 * speed * std::sin(0.7 * phase)), 0);
        }
        const std::shared_ptr<const Model> shared = model;
        if (test::count_overlaps(*shared, std::vector<glm::vec4>(shared->positions)) > 0) continue;
        cpu::SystemSolver<float> solver = make_solver<float>(
            shared, random.uniform(0.0, 0.8), random.integer(1, 12), random.integer(0, 1) == 1);
        const int substeps = random.integer(1, 4);
        const test::BodySums energy = test::sum_bodies(*shared, solver.nodes());
        ASSERT_TRUE(test::stays_apart(solver, *shared, 30 * substeps, kFrame / substeps,
                                      energy.sum() + 0.2 * energy.kinetic))
            << "scene " << seed;
    }
}

TEST(OwnContact, NothingPassesThroughItself) {
    fuzz_folds(1, 3);
}

TEST(OwnContactHeavy, NothingPassesThroughItself) {
    fuzz_folds(4, 9);
}

TEST(OwnContactLong, NothingPassesThroughItself) {
    fuzz_folds(100, 300);
}

}  // namespace
}  // namespace gelatin
