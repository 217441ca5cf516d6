// Tets in lanes against the plain formulas in double.
#include <gtest/gtest.h>

#include <random>

#include "cpu/descent/step_objective.h"
#include "support/instruction_sets.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr float kTermStep = 0.01f;  // [s]

// What a step of the model begins with, but for positions: at rest where the model says, elsewhere `moved`.
template <class Real>
cpu::StepObjective<Real> make_objective(const std::shared_ptr<const Model>& model) {
    cpu::StepObjective<Real> objective(model, std::numeric_limits<std::uint32_t>::max());
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        const float x = normal(random), y = normal(random), z = normal(random);
        const glm::vec3 start = glm::vec3(model->positions[n]) + 0.01f * glm::vec3(x, y, z);
        objective.step.starts[n] = cpu::Vec4<Real>(cpu::Vec3<Real>(start), model->velocities[n].w);
        const float inverse_mass = model->positions[n].w;
        objective.step.targets[n] =
            cpu::Vec4<Real>(cpu::Vec3<Real>(start),
                            inverse_mass > 0.0f ? 1.0f / (inverse_mass * kTermStep * kTermStep) : 0.0f);
    }
    objective.begin(static_cast<Real>(kTermStep));
    return objective;
}

// All terms of all nodes. Errors are those of single precision: differences of positions of about a metre,
// and some forty elements a node, relative to the stiffness of these.
void expect_the_plain_terms_here(const Model& model) {
    const auto shared = std::make_shared<const Model>(model);
    auto fast = make_objective<float>(shared);
    auto plain = make_objective<double>(shared);
    const std::vector<glm::vec4>& positions = model.positions;
    const std::vector<glm::dvec4> positions_d(positions.begin(), positions.end());
    fast.update(0, TetUpdate::all, positions);
    plain.update(0, TetUpdate::all, positions_d);
    std::vector<glm::vec3> forces(positions.size());
    fast.find_forces(positions, forces);
    int compared = 0;
    for (std::size_t group = 0; group < fast.group_count(); ++group) {
        std::vector<glm::vec4> moved = positions;
        std::vector<glm::dvec4> moved_d = positions_d;
        cpu::TermColumns lanes;
        cpu::PlainTerms rows;
        fast.descend(group, fast.any_flat_tets(), moved, lanes);
        plain.descend(group, plain.any_flat_tets(), moved_d, rows);
        for (std::size_t r = 0; r < cpu::kGroup; ++r) {
            const std::uint32_t node = fast.rows().nodes[group * cpu::kGroup + r];
            if (node == kNoNode || model.positions[node].w == 0.0f) continue;
            ++compared;
            const cpu::NodeTerms<float> actual = lanes.row(r);
            const cpu::NodeTerms<double>& expected = rows.row(r);
            const glm::dvec3& d = expected.hessian.diagonal;
            const double stiffness = d.x + d.y + d.z;
            EXPECT_LT(glm::distance(glm::dvec3(actual.force), expected.force), 2e-6 * stiffness) << node;
            EXPECT_EQ(forces[node], actual.force) << node;
            EXPECT_LT(glm::distance(glm::dvec3(actual.hessian.diagonal), d), 2e-5 * stiffness) << node;
            EXPECT_LT(glm::distance(glm::dvec3(actual.hessian.beside), expected.hessian.beside),
                      2e-5 * stiffness)
                << node;
        }
    }
    EXPECT_GT(compared, 100);
}

void expect_the_plain_terms(const Model& model) {
    test::with_each_instruction_set([&] { expect_the_plain_terms_here(model); });
}

TEST(TetTerms, InLanesAreThePlainOnes) {
    for (const double damping : {0.0, 2e-3}) expect_the_plain_terms(test::make_lively_tets(damping));
}

// Of springs, with the volume term.
TEST(TetTerms, OfTheVolumeTermInLanesAreThePlainOnes) {
    for (const double poisson_ratio : {0.1, 0.4}) {
        Body body = test::make_body(test::make_block({5, 5, 4}, {0.5, 0.5, 0.4}, 0.2));
        body.material.youngs_modulus = 2e4;
        body.material.poisson_ratio = poisson_ratio;
        Model model = test::make_model(body);
        std::mt19937 random(2);
        std::normal_distribution<float> normal;
        for (glm::vec4& p : model.positions) {
            const float x = normal(random), y = normal(random), z = normal(random);
            p += 0.02f * glm::vec4(x, y, z, 0.0f);
        }
        expect_the_plain_terms(model);
    }
}

// Flat, inverted, and nearly a point, where tets open in their rest orientation.
TEST(TetTerms, OfCrushedBodiesInLanesAreThePlainOnes) {
    for (const glm::vec3 scale :
         {glm::vec3(1.0f, 1e-3f, 1.0f), glm::vec3(-1.0f, 1.0f, 1.0f), glm::vec3(0.02f)}) {
        Model model = test::make_lively_tets(1e-3);
        for (glm::vec4& p : model.positions) p = glm::vec4(scale * glm::vec3(p), p.w);
        expect_the_plain_terms(model);
    }
}

}  // namespace
}  // namespace gelatin
