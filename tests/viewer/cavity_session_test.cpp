// What a session reads of cavities, gives them and saves.
#include <gtest/gtest.h>

#include "model/assembly/build_model.h"
#include "support/shells.h"
#include "support/simulator_fixture.h"
#include "viewer/session.h"

namespace gelatin::viewer {
namespace {

/// Two hollow balls in space, one sealed, one with a regulated pressure that grows.
class CavitySession : public test::GlTest {
protected:
    static LoadedScene balls(double gravity = 0.0) {
        Scene scene;
        scene.simulation.gravity = glm::dvec3(0.0, gravity, 0.0);
        Material& rubber = scene.materials.emplace_back();
        rubber.name = "rubber";
        rubber.model = MaterialModel::neo_hookean;
        rubber.youngs_modulus = 1e6;
        rubber.damping = 0.05;
        for (const char* name : {"tight", "fed"}) {
            ObjectDescription& ball = scene.objects.emplace_back();
            ball.name = name;
            ball.shape = MeshShape{test::sphere_shell(0.2, 0.25, 3, 1)};
            ball.material = "rubber";
        }
        scene.objects[1].position = {1.0, 0.0, 0.0};
        scene.objects[0].cavities = {{.pressure = 1e3}};
        scene.objects[1].cavities = {
            {.law = GasLaw::constant,
             .keyframes = {{.time = 0.0, .pressure = 0.0}, {.time = 1.0, .pressure = 2e3}}}};
        return build_scene(scene);
    }

    // Pictures of a sixtieth of a second.
    void run(Session& session, int pictures) {
        for (int k = 0; k < pictures; ++k) {
            session.update(now_ += 1.0 / 60.0);
            while (session.is_computing()) {
            }
        }
        session.update(now_ += 1e-6);
    }

    double now_ = 0.0;
};

TEST_F(CavitySession, SetsPressuresAndAmounts) {
    Session session(balls(), Backend::cpu);
    ASSERT_EQ(session.cavities().size(), 2u);
    run(session, 30);
    EXPECT_EQ(session.cavity_gas(0).amount, 1.0);
    EXPECT_NEAR(*session.cavity_gas(1).pressure, 2e3 * session.time(), 1e-9) << "by the keyframes";
    const double volume = session.cavities()[0].volume;
    session.set_cavity(0, {.amount = 1.5});
    session.set_cavity(1, {.pressure = 9e3});
    EXPECT_EQ(session.cavity_gas(1).pressure, 9e3) << "before the next batch";
    run(session, 30);
    EXPECT_GT(session.cavities()[0].volume, 1.02 * volume);
    EXPECT_NEAR(session.cavities()[1].pressure, 9e3, 1e-6);
    session.reset();
    run(session, 1);
    EXPECT_EQ(session.cavity_gas(0).amount, 1.0);
    EXPECT_LT(*session.cavity_gas(1).pressure, 1e3);
}

TEST_F(CavitySession, RefusalsAreTold) {
    Session session(balls(), Backend::cpu);
    session.set_cavity(1, {.pressure = -2e5});
    run(session, 2);
    EXPECT_NE(session.take_refusal().find("greater than -101325"), std::string::npos);
    EXPECT_LT(*session.cavity_gas(1).pressure, 1e3) << "it has what it had";
}

// Edits make another session, which has what was set, and so has what is saved.
TEST_F(CavitySession, WhatIsSetOutlivesEditsAndIsSaved) {
    Session first(balls(), Backend::cpu);
    run(first, 2);
    first.set_cavity(1, {.pressure = 4e3});
    run(first, 2);
    Session second(balls(-1.0), Backend::cpu, &first);
    EXPECT_EQ(second.cavity_gas(1).pressure, 4e3);
    EXPECT_NEAR(second.cavities()[1].pressure, 4e3, 1e-6);
    run(second, 2);
    EXPECT_NEAR(second.cavities()[1].pressure, 4e3, 1e-6);
    Scene scene = second.scene();
    second.save_gas(scene);
    EXPECT_EQ(scene.objects[1].cavities[0].pressure, 4e3);
    EXPECT_TRUE(scene.objects[1].cavities[0].keyframes.empty());
    EXPECT_EQ(scene.objects[0].cavities[0].pressure, 1e3);
}

}  // namespace
}  // namespace gelatin::viewer
