#include <gtest/gtest.h>

#include <filesystem>

#include "core/file.h"
#include "gelatin/recording.h"
#include "support/simulator_fixture.h"
#include "viewer/session.h"

namespace gelatin::viewer {
namespace {

/// A recording of 20 frames in the viewer.
class RecordingSession : public test::GlTest {
protected:
    void SetUp() override {
        test::GlTest::SetUp();
        if (IsSkipped()) return;
        SimulatorOptions options;
        options.backend = Backend::cpu;
        Simulator simulator(test::falling_balls(), options);
        RecordingWriter writer(file(), simulator);
        for (int k = 0; k < 20; ++k) {
            writer.write(simulator);
            last_ = simulator.read_frame();
            simulator.advance_frame();
        }
        writer.finish();
    }

    std::filesystem::path file() const { return folder_.path() / "run.gel"; }
    Session open() const { return {load_scene_source({{file()}}), Backend::cpu}; }

    // Pictures of a sixtieth of a second, until nothing is under way any more.
    void run(Session& session) {
        for (int k = 0; k < 2000; ++k) {
            session.update(now_ += 1.0 / 60.0);
            while (session.is_computing()) {
            }
            if (!session.is_busy()) break;
        }
        session.update(now_ += 1.0 / 60.0);
    }

    TemporaryFolder folder_;
    HostFrame last_;
    double now_ = 0.0;
};

TEST_F(RecordingSession, PlaysToTheEndAndBeginsAnew) {
    Session session = open();
    run(session);
    EXPECT_FALSE(session.is_playing());
    EXPECT_EQ(session.frame(), 19);
    EXPECT_EQ(session.simulator().read_frame().positions, last_.positions);
    session.play(true);
    session.update(now_ += 1e-4);
    EXPECT_LT(session.frame(), 19);
    run(session);
    EXPECT_EQ(session.frame(), 19);
}

TEST_F(RecordingSession, GoesToAnyFrame) {
    Session session = open();
    session.play(false);
    session.show_recorded(7);
    run(session);
    EXPECT_EQ(session.frame(), 7);
    EXPECT_EQ(session.index(), 7u);
    session.make_steps(2);
    run(session);
    EXPECT_EQ(session.frame(), 9);
    session.reset();
    run(session);
    EXPECT_EQ(session.frame(), 0);
}

TEST_F(RecordingSession, GoesOnAsASimulation) {
    Session played = open();
    played.play(false);
    played.show_recorded(19);
    run(played);
    Session session(build_scene(played.scene()), Backend::cpu, &played);
    EXPECT_EQ(session.recording(), nullptr);
    EXPECT_EQ(session.simulator().read_frame().positions, last_.positions);
    session.make_steps(session.simulator().substeps());
    run(session);
    EXPECT_EQ(session.frame(), 20);
}

}  // namespace
}  // namespace gelatin::viewer
