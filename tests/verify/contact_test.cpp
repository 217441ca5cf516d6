// A node against a plane, by explicit steps: restitution, sliding, and the slope on which it starts to slide.
#include <gtest/gtest.h>

#include <cmath>

#include "cpu/explicit/explicit_solver.h"
#include "gpu/explicit/explicit_solver.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin::contact_test {
namespace {

Collider plane(double slope_degrees, double friction, double restitution) {
    const double angle = slope_degrees * 3.14159265358979323846 / 180.0;
    Collider c{};
    c.center = glm::vec4(std::sin(angle), std::cos(angle), 0.0, 0.0);
    c.friction = static_cast<float>(friction);
    c.restitution = static_cast<float>(restitution);
    return c;
}

Model node_at(glm::dvec3 position, glm::dvec3 velocity, const Collider& collider) {
    test::Net net;
    net.positions = {position};
    net.velocities = {velocity};
    net.masses = {2.0};
    net.gravity = {0.0, -9.81, 0.0};
    net.colliders = {collider};
    return test::make_model(net);
}

std::vector<std::unique_ptr<Solver>> solvers_for(const Model& model, bool with_gl) {
    const auto shared = std::make_shared<const Model>(model);
    std::vector<std::unique_ptr<Solver>> solvers;
    for (const ForceMethod forces : {ForceMethod::fused, ForceMethod::divide_and_merge}) {
        solvers.push_back(
            std::make_unique<cpu::ExplicitSolver<float>>(shared, SolverKind::semi_implicit_euler, forces));
        if (with_gl) {
            solvers.push_back(
                std::make_unique<gpu::ExplicitSolver>(shared, SolverKind::semi_implicit_euler, forces));
        }
    }
    return solvers;
}

class ContactTest : public test::GlTest {};

// Dropped from h it rebounds to e^2 h; the step makes the speeds at impact and the height off by g h_step
// each.
TEST_F(ContactTest, ReboundsToTheSquareOfTheRestitution) {
    constexpr double kStep = 1e-3, kHeight = 1.0;
    for (const double restitution : {0.3, 0.8, 1.0}) {
        for (const auto& solver :
             solvers_for(node_at({0, kHeight, 0}, {}, plane(0.0, 0.4, restitution)), true)) {
            double highest = 0.0;
            bool rising = false;
            for (int s = 0; s < 1200; ++s) {
                solver->advance({kStep});
                const State state = solver->read_state();
                rising = rising || state.velocities[0].y > 0.0f;
                if (rising) highest = std::max(highest, static_cast<double>(state.positions[0].y));
                if (rising && state.velocities[0].y < 0.0f) break;
            }
            const double impact_speed = std::sqrt(2.0 * 9.81 * kHeight);
            EXPECT_NEAR(highest, restitution * restitution * kHeight, 2.0 * impact_speed * kStep);
        }
    }
}

// A node that slides at v stops after v^2 / (2 mu g).
TEST_F(ContactTest, SlidesAsFarAsFrictionAllows) {
    constexpr double kStep = 1e-3, kSpeed = 2.0;
    for (const double friction : {0.25, 0.5}) {
        for (const auto& solver :
             solvers_for(node_at({0, 0, 0}, {kSpeed, 0, 0}, plane(0.0, friction, 0.5)), true)) {
            for (int s = 0; s < 1000; ++s) solver->advance({kStep});
            const State state = solver->read_state();
            EXPECT_NEAR(state.positions[0].x, kSpeed * kSpeed / (2.0 * friction * 9.81), kSpeed * kStep);
            EXPECT_EQ(state.velocities[0].x, 0.0f);
        }
    }
}

// It slides where tan(slope) > mu, and then with g (sin - mu cos).
TEST_F(ContactTest, SlidesOnSlopesSteeperThanFriction) {
    constexpr double kStep = 1e-3, kTime = 0.5, kSlope = 30.0;  // tan = 0.577
    const double sine = 0.5, cosine = std::sqrt(0.75);
    for (const double friction : {0.3, 0.7}) {
        const double expected = friction < sine / cosine ? 9.81 * (sine - friction * cosine) * kTime : 0.0;
        for (const auto& solver : solvers_for(node_at({0, 0, 0}, {}, plane(kSlope, friction, 0.0)), true)) {
            for (int s = 0; s < 500; ++s) solver->advance({kStep});
            const glm::vec3 v(solver->read_state().velocities[0]);
            EXPECT_NEAR(glm::length(v), expected, 9.81 * 2.0 * kStep);
        }
    }
}

TEST_F(ContactTest, NothingSinksIntoAPlane) {
    Body body = test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2));
    body.material.damping = 2e-3;
    for (glm::dvec3& p : body.mesh.positions) p.y += 0.3;
    const Model model = pack_bodies({body}, {ColliderDescription{}}, {0.0, -9.81, 0.0});
    cpu::ExplicitSolver<float> solver(std::make_shared<const Model>(model), SolverKind::semi_implicit_euler,
                                      ForceMethod::fused);
    for (int s = 0; s < 2000; ++s) {
        solver.advance({5e-4});
        solver.begin_measure();
        EXPECT_LT(solver.end_measure().objects[0].deepest_penetration, 1e-6);
    }
    solver.begin_measure();
    EXPECT_GT(solver.end_measure().objects[0].contacts, 8u) << "it lies on the floor by now";
}

}  // namespace
}  // namespace gelatin::contact_test
