// The forces of pins and handles, against closed forms: weights, the stress of a stretched bar, and what
// accelerates a body.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/implicit/system_solver.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "support/test_models.h"

namespace gelatin::holding_force_test {
namespace {

constexpr double kGravity = 9.81;                             // [m/s^2]
constexpr double kStep = 1.0 / 60.0;                          // [s]
constexpr double kLength = 0.5, kWidth = 0.125;               // [m]
constexpr double kMass = 1000.0 * kLength * kWidth * kWidth;  // [kg]
constexpr double kWeight = kMass * kGravity;                  // [N]

Material soft(MaterialModel kind, double damping = 5e-2) {
    Material material;
    material.model = kind;
    material.youngs_modulus = 5e4;
    material.density = 1000.0;
    material.damping = damping;
    return material;
}

// Along x, from 0 to kLength.
Body bar(const Material& material, int cells_across = 3) {
    return test::make_body(
        test::make_block({4 * cells_across, cells_across, cells_across}, {kLength, kWidth, kWidth}, 0.1),
        material);
}

Region left_end() {
    return HalfSpaceRegion{{1, 0, 0}, 1e-6};
}
Region right_end() {
    return HalfSpaceRegion{{-1, 0, 0}, -kLength + 1e-6};
}

// Takes the place of the simulator.
class HeldRun {
public:
    HeldRun(const Body& body, const glm::dvec3& gravity, int iterations = 10)
        : model_(std::make_shared<const Model>(test::make_model(body, gravity))),
          solver_(model_, {}, ImplicitSettings{.iterations = iterations}) {}

    void advance(int steps) {
        for (; steps > 0; --steps, ++steps_) {
            solver_.advance({kStep, handle_motions(model_->handles, steps_ * kStep, kStep)});
        }
    }
    // By springs from all nodes to their places at the start, moved by `displacement`.
    void pull(const glm::dvec3& displacement) {
        pull_.target = displacement;
        pull_.damping_time = 0.1;
        for (std::uint32_t n = 0; n < model_->node_count(); ++n)
            pull_.nodes.push_back({n, glm::vec3(model_->positions[n]), model_->masses[n]});
        solver_.set_pulls({pull_});
    }
    glm::dvec3 force_of_hand() const {
        glm::dvec3 force(0.0);
        for (const Pull::Node& held : pull_.nodes)
            force += static_cast<double>(held.stiffness) *
                     (pull_.target + glm::dvec3(held.arm) - glm::dvec3(solver_.nodes().positions[held.node]));
        return force;
    }
    const Model& model() const { return *model_; }
    const cpu::CpuSolver<float>& solver() const { return solver_; }
    HoldingForces forces() { return solver_.holding_forces(); }

private:
    std::shared_ptr<const Model> model_;
    cpu::SystemSolver<float> solver_;
    Pull pull_;
    int steps_ = 0;
};

class HoldingForce : public ::testing::TestWithParam<MaterialModel> {};
INSTANTIATE_TEST_SUITE_P(Models, HoldingForce,
                         ::testing::Values(MaterialModel::mass_spring, MaterialModel::neo_hookean),
                         [](const auto& test) {
                             return test.param == MaterialModel::mass_spring ? "springs" : "tets";
                         });

// Whether it hangs or sticks out, with the moment of its weight about the end.
TEST_P(HoldingForce, OfAPinIsTheWeightOfABarAtRest) {
    for (const glm::dvec3 gravity : {glm::dvec3(kGravity, 0, 0), glm::dvec3(0, -kGravity, 0)}) {
        Body body = bar(soft(GetParam()));
        body.pins = {left_end()};
        HeldRun run(body, gravity);
        EXPECT_EQ(run.forces().by_handle[0], glm::dvec3(0.0)) << "before the first step";
        run.advance(1500);
        const HoldingForces forces = run.forces();
        EXPECT_LT(glm::distance(forces.by_handle[0], -kMass * gravity), 1e-4 * kWeight);
        glm::dvec3 moment(0.0), sum(0.0);
        const glm::dvec3 center(0.0, 0.5 * kWidth, 0.5 * kWidth);
        for (std::uint32_t n = 0; n < run.model().node_count(); ++n) {
            const glm::dvec3 arm = glm::dvec3(run.solver().nodes().positions[n]) - center;
            moment -= glm::cross(arm, static_cast<double>(run.model().masses[n]) * gravity);
            sum += forces.nodes[n];
        }
        EXPECT_LT(glm::distance(forces.torques[0], moment), 1e-4 * kWeight * kLength);
        EXPECT_LT(glm::distance(sum, forces.by_handle[0]), 1e-9 * kWeight);
    }
}

// m (g + a). Sweeps that have not converged leave the rest: 1.3% with ten.
TEST_P(HoldingForce, OfAHandleThatLiftsIsMassTimesGravityAndAcceleration) {
    for (const double acceleration : {3.0, -2.0}) {
        Body body = bar(soft(GetParam()));
        HandleDescription handle;
        handle.region = left_end();
        for (int k = 0; k <= 500; ++k) {
            const double time = k * kStep;
            handle.keyframes.push_back({time, {0.0, 0.5 * acceleration * time * time, 0.0}});
        }
        body.handles = {handle};
        HeldRun run(body, {0, -kGravity, 0}, 40);
        run.advance(500);
        EXPECT_LT(glm::distance(run.forces().by_handle[0], {0, kMass * (kGravity + acceleration), 0}),
                  0.008 * kWeight);
    }
}

// E A e: the ends may not contract, which makes the bar stiffer by a little.
TEST_P(HoldingForce, OfHandlesThatStretchIsYoungsModulusTimesStrain) {
    for (const double strain : {0.02, -0.02}) {
        Body body = bar(soft(GetParam()), 4);
        HandleDescription handle;
        handle.region = right_end();
        handle.keyframes = {{0.0}, {1.0, {strain * kLength, 0.0, 0.0}}};
        body.handles = {handle};
        body.pins = {left_end()};
        HeldRun run(body, {0, 0, 0});
        run.advance(600);
        const HoldingForces forces = run.forces();
        const double expected = 5e4 * kWidth * kWidth * strain;
        EXPECT_NEAR(forces.by_handle[0].x / expected, 1.0, 0.03);
        EXPECT_NEAR(forces.by_handle[1].x / forces.by_handle[0].x, -1.0, 1e-3);
    }
}

// A load and a hand on all nodes, held ones too: what is held and what hangs on it feel their share.
TEST_P(HoldingForce, CarriesLoadsAndPulls) {
    const glm::dvec3 pushed(20.0, -30.0, 10.0);  // [N]
    for (const bool by_hand : {false, true}) {
        Body body = bar(soft(GetParam()));
        body.pins = {left_end()};
        if (!by_hand) body.loads = {{HalfSpaceRegion{{0, 1, 0}, 1.0}, ForceLoad{pushed}}};
        HeldRun run(body, {0, 0, 0});
        if (by_hand) run.pull({4.0, -6.0, 2.0});
        run.advance(1500);
        const glm::dvec3 force = run.forces().by_handle[0];
        const glm::dvec3 expected = by_hand ? -run.force_of_hand() : -pushed;
        EXPECT_GT(glm::length(expected), 1.0);
        EXPECT_LT(glm::distance(force, expected), 1e-3 * glm::length(expected)) << by_hand;
    }
}

// A dragged end, hurried along: dampers of springs and tets are forces on it like others, so pin and handle
// together accelerate the body as a whole.
TEST_P(HoldingForce, CountsDampers) {
    Body body = bar(soft(GetParam(), 0.5));
    HandleDescription handle;
    handle.region = right_end();
    handle.keyframes = {{0.0}, {10.0, {0.5 * kLength, 0.0, 0.0}}};
    body.handles = {handle};
    body.pins = {left_end()};
    HeldRun run(body, {0, 0, 0});
    run.advance(6);
    const HoldingForces moving = run.forces();
    // The strain rate of 0.05 / s after 0.1 s: E A (e + t de/dt).
    const double expected = 5e4 * kWidth * kWidth * 0.05 * (0.1 + 0.5);
    EXPECT_NEAR(moving.by_handle[0].x / expected, 1.0, 0.1);
}

TEST_P(HoldingForce, IsZeroOnceAHandleHasReleased) {
    Body body = bar(soft(GetParam()));
    HandleDescription handle;
    handle.region = left_end();
    handle.release = 0.1;
    body.handles = {handle};
    HeldRun run(body, {0, -kGravity, 0});
    run.advance(3);
    EXPECT_GT(glm::length(run.forces().by_handle[0]), 0.1 * kWeight);
    run.advance(6);
    EXPECT_EQ(run.forces().by_handle[0], glm::dvec3(0.0));
}

}  // namespace
}  // namespace gelatin::holding_force_test
