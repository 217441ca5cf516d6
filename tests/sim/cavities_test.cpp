// What programs read of cavities and give them, and what checkpoints keep.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "gelatin/error.h"
#include "gelatin/recording.h"
#include "sim/report.h"
#include "support/shells.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

class CavitiesTest : public test::SimulatorFixture {
protected:
    // Two balls above a floor, one sealed, one with a regulated pressure.
    static Scene balls() {
        Scene scene;
        Material& rubber = scene.materials.emplace_back();
        rubber.name = "rubber";
        rubber.model = MaterialModel::neo_hookean;
        rubber.youngs_modulus = 1e6;
        rubber.damping = 0.05;
        const auto mesh = test::sphere_shell(0.2, 0.25, 3, 1);
        for (const char* name : {"tight", "fed"}) {
            ObjectDescription& ball = scene.objects.emplace_back();
            ball.name = name;
            ball.shape = MeshShape{mesh};
            ball.material = "rubber";
        }
        scene.objects[1].position = {1.0, 0.0, 0.0};
        scene.objects[0].cavities = {{.pressure = 1e4}};
        scene.objects[1].cavities = {{.name = "air", .law = GasLaw::constant, .pressure = 5e3}};
        scene.colliders.emplace_back().shape = PlaneCollider{{0.0, 1.0, 0.0}, -0.26};
        return scene;
    }
    static std::string error_of(const std::function<void()>& act) {
        try {
            act();
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "no error";
    }
    static void advance(Simulator& simulator, int frames) {
        for (int k = 0; k < frames; ++k) simulator.advance_frame();
    }
};

TEST_F(CavitiesTest, AreReadAndReported) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(balls(), on(backend));
        advance(simulator, 3);
        const std::vector<CavityStatus> all = simulator.cavities();
        ASSERT_EQ(all.size(), 2u);
        EXPECT_EQ(all[0].name, "cavity 1");
        EXPECT_EQ(all[1].name, "air");
        EXPECT_EQ(all[1].object, 1u);
        EXPECT_EQ(all[1].pressure, 5e3);
        EXPECT_LT(all[0].pressure, 1e4);  // it has grown
        EXPECT_GT(all[0].pressure, 0.0);
        simulator.begin_statistics();
        RunReport report = describe_run(simulator);
        report.frames = {simulator.take_statistics()};
        const auto json = nlohmann::json::parse(to_json(report))["frames"][0]["cavities"];
        EXPECT_EQ(json[1]["object"], "fed");
        EXPECT_EQ(json[1]["name"], "air");
        EXPECT_EQ(json[0]["volume"], all[0].volume);
        EXPECT_EQ(json[0]["pressure"], all[0].pressure);
    }
}

// With OpenGL the host makes the steps: to the same bits.
TEST_F(CavitiesTest, BackendsAreTheSame) {
    Simulator cpu(balls(), on(Backend::cpu)), gl(balls(), on(Backend::gl));
    advance(cpu, 20);
    advance(gl, 20);
    EXPECT_TRUE(gl.uses_gl());
    EXPECT_EQ(cpu.read_frame().positions, gl.read_frame().positions);
}

TEST_F(CavitiesTest, ProgramsSetWhatTheyHave) {
    Simulator simulator(balls(), on(Backend::cpu));
    EXPECT_EQ(simulator.cavity_index("fed", "air"), 1u);
    EXPECT_EQ(error_of([&] { simulator.cavity_index("fed", "ait"); }),
              "object 'fed' has no cavity 'ait' (did you mean \"air\"?); there is air");
    EXPECT_EQ(error_of([&] { simulator.set_cavity(2, {.pressure = 1.0}); }),
              "there is no cavity 2: there are 2, from 0");
    EXPECT_EQ(error_of([&] { simulator.set_cavity(1, {.amount = 2.0}); }),
              "cavity.air.amount = 2: is only for law = \"sealed\"");
    EXPECT_EQ(error_of([&] { simulator.set_cavity(0, {}); }), "cavity.cavity 1: needs an amount");
    simulator.set_cavity(0, {.amount = 1.5});
    simulator.set_cavity(1, {.pressure = 2e4});
    advance(simulator, 30);
    EXPECT_EQ(simulator.cavities()[1].pressure, 2e4);
    EXPECT_GT(simulator.cavities()[0].pressure, 2e4);
    simulator.reset();
    advance(simulator, 1);
    EXPECT_EQ(simulator.cavities()[1].pressure, 5e3);
}

// Whoever sleeps is woken, and the other one is not.
TEST_F(CavitiesTest, WhatIsInflatedWakes) {
    Simulator simulator(balls(), on(Backend::cpu));
    advance(simulator, 240);
    const auto positions = [&](std::size_t object) {
        const auto all = simulator.positions();
        const IndexRange nodes = simulator.object(object).nodes;
        return std::vector<glm::vec4>(all.begin() + nodes.first, all.begin() + nodes.end());
    };
    const auto tight = positions(0), fed = positions(1);
    advance(simulator, 1);
    ASSERT_EQ(positions(0), tight);
    ASSERT_EQ(positions(1), fed);
    simulator.set_cavity(1, {.pressure = 2e4});
    advance(simulator, 10);
    EXPECT_EQ(positions(0), tight);
    EXPECT_NE(positions(1), fed);
}

TEST_F(CavitiesTest, CheckpointsHaveWhatProgramsSet) {
    const TemporaryFolder folder;
    Simulator whole(balls(), on(Backend::cpu)), again(balls(), on(Backend::cpu));
    advance(whole, 5);
    whole.set_cavity(1, {.pressure = 2e4});
    advance(whole, 5);
    whole.save_checkpoint(folder.path() / "a.ckpt");
    again.load_checkpoint(folder.path() / "a.ckpt");
    EXPECT_EQ(again.cavities()[1].pressure, 2e4);
    for (Simulator* each : {&whole, &again}) {
        advance(*each, 10);
        each->set_cavity(0, {.amount = 1.2});
        advance(*each, 10);
    }
    EXPECT_EQ(again.read_frame().positions, whole.read_frame().positions);
    EXPECT_EQ(again.read_frame().velocities, whole.read_frame().velocities);
}

// A pressure is no amount.
TEST_F(CavitiesTest, WhatProgramsSetIsRefusedByOtherLaws) {
    const TemporaryFolder folder;
    const auto checkpoint = folder.path() / "a.ckpt", recorded = folder.path() / "a.gel";
    Simulator run(balls(), on(Backend::cpu));
    run.save_checkpoint(checkpoint);
    Scene other = balls();
    other.objects[1].cavities = {{.name = "air"}};
    Simulator sealed(other, on(Backend::cpu));
    sealed.load_checkpoint(checkpoint);  // nothing is set: where nodes are is what counts
    run.set_cavity(1, {.pressure = 2e4});
    advance(run, 1);
    run.save_checkpoint(checkpoint);
    RecordingWriter writer(recorded, run);
    writer.write(run);
    writer.finish();
    other.objects[1].cavities.clear();
    Simulator none(other, on(Backend::cpu));
    for (const auto& file : {checkpoint, recorded})
        for (Simulator* each : {&sealed, &none}) {
            EXPECT_EQ(error_of([&] { each->load_checkpoint(file); }),
                      file.string() + ": was made from a scene with other cavities");
            EXPECT_EQ(each->frame(), 0);
        }
}

TEST_F(CavitiesTest, RecordingsHaveWhatProgramsSet) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "run.gel";
    Simulator run(balls(), on(Backend::cpu));
    RecordingWriter writer(file, run);
    std::vector<std::vector<CavityStatus>> statuses;
    for (int k = 0; k < 8; ++k) {
        if (k == 3) run.set_cavity(1, {.pressure = 2e4});
        advance(run, 1);
        writer.write(run);
        statuses.push_back(run.cavities());
    }
    writer.finish();
    Simulator player(std::make_shared<const Recording>(file), on(Backend::cpu));
    for (const std::size_t k : {0u, 7u, 2u, 3u}) {
        player.show_recorded(k);
        const std::vector<CavityStatus> shown = player.cavities();
        ASSERT_EQ(shown.size(), 2u);
        for (std::size_t c = 0; c < 2; ++c) {
            EXPECT_EQ(shown[c].pressure, statuses[k][c].pressure) << "frame " << k << ", cavity " << c;
            EXPECT_EQ(shown[c].volume, statuses[k][c].volume) << "frame " << k << ", cavity " << c;
        }
    }
    EXPECT_EQ(player.cavities()[1].pressure, 2e4);
    Simulator later(balls(), on(Backend::cpu)), other(balls(), on(Backend::cpu));
    later.load_checkpoint(file);
    other.go_on_from(player);
    for (Simulator* each : {&later, &other}) {
        advance(*each, 1);
        EXPECT_EQ(each->cavities()[1].pressure, 2e4);
        EXPECT_NE(each->cavities()[0].pressure, 2e4);
    }
}

// Materials are changed while it is inflated.
TEST_F(CavitiesTest, StayWhereTablesAreMadeAnew) {
    Simulator simulator(balls(), on(Backend::cpu));
    simulator.set_cavity(1, {.pressure = 2e4});
    advance(simulator, 60);
    const double before = simulator.cavities()[1].volume;
    Material soft = simulator.scene().materials[0];
    soft.youngs_modulus = 7e5;
    simulator.set_material(soft);
    EXPECT_EQ(simulator.cavities()[1].pressure, 2e4);
    advance(simulator, 60);
    EXPECT_GT(simulator.cavities()[1].volume, 1.05 * before);
}

}  // namespace
}  // namespace gelatin
