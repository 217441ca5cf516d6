#include "cpu/block_descent.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "cpu/cpu_solver.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

TEST(BlockDescentTry, Prints) {
    for (const double E : {1e3, 1e4, 1e6, 1e9}) {
        Body body = test::make_body(test::make_block({6, 6, 6}, {0.3, 0.3, 0.3}, 0.2));
        body.material.youngs_modulus = E;
        body.velocity = {1, 2, 0};
        auto model = std::make_shared<Model>(pack_bodies({body}, {}, {0, -9.81, 0}));
        cpu::BlockDescent<float>::hack_rest() = model->positions;
        cpu::BlockDescent<double>::hack_rest() = model->positions;
        std::mt19937 random(1);
        std::uniform_real_distribution<float> unit(-0.3f, 0.3f);
        for (auto& p : model->positions) p += glm::vec4(unit(random), unit(random), unit(random), 0);
        cpu::CpuSolver<float> solver(model, SolverKind::vbd, ForceMethod::fused, {}, 20);
        for (int k = 0; k < 300; ++k) {
            solver.advance_nodes(1.0 / 60);
            if (k % 100 == 99 || k == 20) {
                double worst = 0, mass = 0; glm::dvec3 p(0);
                for (const Spring& s : model->springs) {
                    const double l = glm::distance(glm::dvec3(solver.nodes().positions[s.i]), glm::dvec3(solver.nodes().positions[s.j]));
                    worst = std::max(worst, std::abs(l / double(s.rest_length) - 1));
                }
                for (std::uint32_t n = 0; n < model->node_count(); ++n) { const double m = 1.0 / double(model->positions[n].w); mass += m; p += m * glm::dvec3(solver.nodes().velocities[n]); }
                double inverted = 0;
                for (auto& t : model->tets) { auto x = [&](int i) { return glm::dvec3(solver.nodes().positions[t[i]]); }; if (glm::dot(glm::cross(x(1) - x(0), x(2) - x(0)), x(3) - x(0)) <= 0) ++inverted; }
                std::printf("E %.0e step %d worst strain %.4f inverted %.0f of %zu, velocity %.5f %.5f want %.5f\n", E, k + 1, worst, inverted, model->tets.size(), p.x / mass, p.y / mass, 2 - 9.81 * (k + 1) / 60);
            }
        }
    }
}

}  // namespace
}  // namespace gelatin
