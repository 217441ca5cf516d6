#include "gelatin/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/file.h"
#include "gelatin/error.h"
#include "gelatin/log.h"
#include "sim/recording/earlier_neighbours.h"
#include "sim/recording/recorded_frame.h"
#include "sim/recording/residuals.h"
#include "sim/simulator_internals.h"
#include "support/random_maker.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

bool operator==(const HostFrame& a, const HostFrame& b) {
    return a.frame == b.frame && a.time == b.time && a.positions == b.positions &&
           a.velocities == b.velocities && a.contact_forces == b.contact_forces &&
           a.contact_friction == b.contact_friction && a.holding_forces == b.holding_forces;
}

class RecordingTest : public testing::Test {
protected:
    static SimulatorOptions on_cpu() {
        SimulatorOptions options;
        options.backend = Backend::cpu;
        return options;
    }

    fs::path file() const { return folder_.path() / "run.gel"; }

    // The frames of a run of so many, of which every k-th and the last are recorded.
    std::vector<HostFrame> record(const Scene& scene, int frames, int every = 1) const {
        Simulator simulator(scene, on_cpu());
        RecordingWriter writer(file(), simulator);
        std::vector<HostFrame> all;
        for (int frame = 0; frame <= frames; ++frame) {
            if (frame > 0) simulator.advance_frame();
            if (frame % every != 0 && frame < frames) continue;
            writer.write(simulator);
            all.push_back(simulator.read_frame());
        }
        writer.finish();
        return all;
    }

    std::shared_ptr<const Recording> open() const { return std::make_shared<const Recording>(file()); }

    void expect_refused(const std::string& problem) const {
        try {
            Simulator(open(), on_cpu());
            ADD_FAILURE() << "it was not refused";
        } catch (const InvalidInput& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(problem));
            EXPECT_THAT(error.what(), testing::HasSubstr("run.gel"));
        }
    }

    TemporaryFolder folder_;
};

Scene balls_that_meet() {
    Scene scene = test::falling_balls();
    scene.simulation.solver = SolverKind::implicit;
    scene.simulation.frame_rate = 60.0;
    scene.objects[0].velocity = {1.5, 0, 0};
    return scene;
}

TEST_F(RecordingTest, PlaysWhatTheRunWasToTheLastBit) {
    const std::vector<HostFrame> frames = record(balls_that_meet(), 70);  // over two key frames
    Simulator player(open(), on_cpu());
    for (const HostFrame& frame : frames) {
        EXPECT_TRUE(player.read_frame() == frame) << "frame " << frame.frame;
        player.advance_frame();
    }
    EXPECT_EQ(player.frame(), 70) << "there it stays";
    const auto is_pressed = [](const HostFrame& frame) {
        return std::any_of(frame.contact_forces.begin(), frame.contact_forces.end(),
                           [](float value) { return value != 0.0f; });
    };
    EXPECT_TRUE(std::any_of(frames.begin(), frames.end(), is_pressed));
}

TEST_F(RecordingTest, FramesCanBeShownInAnyOrder) {
    const std::vector<HostFrame> frames = record(balls_that_meet(), 70, 2);
    const auto recording = open();
    ASSERT_EQ(recording->frame_count(), frames.size());
    Simulator player(recording, on_cpu());
    for (const std::size_t k : {35u, 0u, 33u, 34u, 3u, 3u, 35u, 1u}) {
        player.show_recorded(k);
        EXPECT_TRUE(player.read_frame() == frames[k]) << k;
        EXPECT_EQ(player.frame(), recording->frame(k));
        EXPECT_EQ(player.time(), recording->time(k));
    }
    EXPECT_EQ(recording->index_of(6), 3u);
    EXPECT_THROW(recording->index_of(7), InvalidInput);
}

TEST_F(RecordingTest, MeasuresAsInTheRun) {
    const Scene scene = test::driven_balls(SolverKind::implicit);
    Simulator run(scene, on_cpu());
    RecordingWriter writer(file(), run);
    for (int k = 0; k < 40; ++k) run.advance_frame();
    writer.write(run);
    writer.finish();
    run.begin_statistics();
    const FrameStatistics measured = run.take_statistics();
    Simulator player(open(), on_cpu());
    player.begin_statistics();
    const FrameStatistics played = player.take_statistics();
    EXPECT_EQ(played.frame, 40);
    EXPECT_EQ(played.kinetic_energy, measured.kinetic_energy);
    EXPECT_EQ(played.elastic_energy, measured.elastic_energy);
    EXPECT_EQ(played.volume_ratio, measured.volume_ratio);
    EXPECT_EQ(played.contacts, measured.contacts);
    ASSERT_EQ(played.contact_forces.size(), measured.contact_forces.size());
    ASSERT_EQ(played.holding_forces.size(), measured.holding_forces.size());
    for (std::size_t h = 0; h < measured.holding_forces.size(); ++h)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(played.holding_forces[h].force[k], measured.holding_forces[h].force[k]);
}

// Of a ball that the implicit step presses against the floor.
TEST_F(RecordingTest, CountsContactsAsInTheRun) {
    for (const auto response : {CollisionResponse::contact, CollisionResponse::restore}) {
        Scene scene = balls_that_meet();
        scene.collision.response = response;
        Simulator run(scene, on_cpu());
        RecordingWriter writer(file(), run);
        for (int k = 0; k < 12; ++k) run.advance_frame();
        writer.write(run);
        writer.finish();
        run.begin_statistics();
        const std::size_t measured = run.take_statistics().contacts;
        EXPECT_GT(measured, 0u);
        Simulator player(open(), on_cpu());
        player.begin_statistics();
        EXPECT_EQ(player.take_statistics().contacts, measured);
    }
}

// Explicit schemes need no more than a frame has. The implicit step begins anew.
TEST_F(RecordingTest, RunsContinueFromAnyFrame) {
    Scene scene = test::driven_balls(SolverKind::semi_implicit_euler);
    scene.collision.response = CollisionResponse::restore;
    for (const SolverKind solver : {SolverKind::implicit, SolverKind::semi_implicit_euler}) {
        scene.simulation.solver = solver;
        const std::vector<HostFrame> frames = record(scene, 50);
        for (const int frame : {0, 17, 32, 40}) {
            Simulator later(scene, on_cpu());
            later.load_checkpoint(file(), frame);
            EXPECT_EQ(later.frame(), frame);
            while (later.frame() < 50) later.advance_frame();
            const HostFrame last = later.read_frame();
            if (solver == SolverKind::implicit) {
                EXPECT_LT(test::largest_difference(last, frames[50]), 2e-3) << frame;
            } else {
                EXPECT_TRUE(last == frames[50]) << "from frame " << frame;
            }
        }
    }
    Simulator later(scene, on_cpu());
    later.load_checkpoint(file());
    EXPECT_EQ(later.frame(), 50);
    EXPECT_THROW(later.load_checkpoint(file(), 51), InvalidInput);
}

// As after a process was killed: whatever was written last, what is before opens.
// Those of a program are not in the file, which has all else.
TEST_F(RecordingTest, PinsOfProgramsDoNotHarmIt) {
    Scene scene = test::falling_balls();
    Simulator simulator(scene, on_cpu());
    RecordingWriter writer(file(), simulator);
    writer.write(simulator);
    simulator.pin(0, std::vector<std::uint32_t>{0, 1, 2});
    for (int frame = 0; frame < 3; ++frame) {
        simulator.advance_frame();
        writer.write(simulator);
    }
    writer.finish();
    Simulator player(open());
    for (std::size_t k = 0; k < 4; ++k) player.show_recorded(k);
    EXPECT_EQ(player.read_frame().positions, simulator.read_frame().positions);
    Simulator free(scene, on_cpu());
    free.load_checkpoint(file());
    EXPECT_GT(free.positions()[0].w, 0.0f) << "not held";
    simulator.load_checkpoint(file(), 1);
    EXPECT_EQ(simulator.positions()[0].w, 0.0f) << "held, as it is here";
    EXPECT_EQ(simulator.frame(), 1);
}

TEST_F(RecordingTest, WhatIsCutOffOpensUpToTheLastWholeFrame) {
    const std::vector<HostFrame> frames = record(balls_that_meet(), 40);
    const std::string whole = read_file(file());
    const std::size_t first = 8;  // within the head, the meshes or the frames
    test::RandomMaker random(7);
    for (int k = 0; k < 50; ++k) {
        const auto size = static_cast<std::size_t>(
            random.integer(static_cast<int>(first), static_cast<int>(whole.size() - 1)));
        write_file(file(), whole.substr(0, size));
        std::shared_ptr<const Recording> recording;
        try {
            recording = open();
        } catch (const InvalidInput& error) {
            EXPECT_THAT(error.what(), testing::AnyOf(testing::HasSubstr("no complete frame"),
                                                     testing::HasSubstr("is cut off before its first frame"),
                                                     testing::HasSubstr("is not a recording")));
            continue;
        }
        Simulator player(recording, on_cpu());
        const std::size_t last = recording->frame_count() - 1;
        player.show_recorded(last);
        EXPECT_TRUE(player.read_frame() == frames[last]) << size;
    }
}

TEST_F(RecordingTest, WhoGoesOnFromWhatIsCutOffReadsWhere) {
    record(balls_that_meet(), 5);
    const std::string whole = read_file(file());
    Simulator later(balls_that_meet(), on_cpu());
    std::vector<std::string> lines;
    set_log_callback([&](Severity severity, std::string_view line) {
        if (severity == Severity::warning) lines.emplace_back(line);
    });
    later.load_checkpoint(file());
    EXPECT_THAT(lines, testing::IsEmpty());
    write_file(file(), whole.substr(0, whole.size() - 1));
    later.load_checkpoint(file());
    EXPECT_EQ(later.frame(), 4);
    later.load_checkpoint(file(), 3);  // which is there
    set_log_callback({});
    EXPECT_THAT(lines,
                testing::ElementsAre(file().string() +
                                     ": is cut off or damaged after frame 4, from which the run goes on"));
}

// A player, an export and a frame's number mean one run.
TEST_F(RecordingTest, FramesAscend) {
    Simulator simulator(balls_that_meet(), on_cpu());
    RecordingWriter writer(file(), simulator);
    for (int frame = 0; frame < 3; ++frame) {
        writer.write(simulator);
        simulator.advance_frame();
    }
    simulator.reset();
    simulator.advance_frame();
    try {
        writer.write(simulator);
        ADD_FAILURE() << "it was not refused";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(std::string(error.what()),
                  file().string() +
                      ": frame = 1: must be after frame 2, which is recorded: after a reset, or an "
                      "earlier checkpoint, another recording begins");
    }
    simulator.advance_frame();
    simulator.advance_frame();
    writer.write(simulator);
    writer.finish();
    const auto recording = open();
    ASSERT_EQ(recording->frame_count(), 4u);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(recording->frame(k), static_cast<int>(k));
}

TEST_F(RecordingTest, DamageIsFoundAndNamed) {
    record(balls_that_meet(), 3);
    const std::string whole = read_file(file());
    std::string damaged = whole;
    damaged[damaged.size() - 5] ^= 1;  // within the last frame
    write_file(file(), damaged);
    Simulator player(open(), on_cpu());
    EXPECT_THROW(player.show_recorded(3), InvalidInput);
    player.show_recorded(2);  // as good as before
    EXPECT_EQ(player.frame(), 2);

    damaged = whole;
    damaged[100] ^= 1;  // within the head
    write_file(file(), damaged);
    expect_refused("is damaged");
    write_file(file(), "GELATRECxxxx");
    expect_refused("is not a recording");
    write_file(file(), "");
    expect_refused("is not a recording");
    fs::remove(file());
    expect_refused("no such file");
}

TEST_F(RecordingTest, OtherMeshesAreRefused) {
    Scene scene = balls_that_meet();
    record(scene, 2);
    std::get<SphereShape>(scene.objects[0].shape).frequency += 1;
    Simulator other(scene, on_cpu());
    EXPECT_THROW(other.load_checkpoint(file()), InvalidInput);
}

TEST_F(RecordingTest, WhatCannotBeWrittenIsAnError) {
    const Simulator simulator(balls_that_meet(), on_cpu());
    EXPECT_THROW(RecordingWriter(folder_.path() / "none" / "run.gel", simulator), SystemError);
    EXPECT_THROW(RecordingWriter("/dev/full", simulator), SystemError);
}

TEST(Residuals, NoBitIsLost) {
    test::RandomMaker random(3);
    const auto any_float = [&] {
        const auto bits = static_cast<std::uint32_t>(random.integer(0, 0xFFFF)) << 16 |
                          static_cast<std::uint32_t>(random.integer(0, 0xFFFF));
        return std::bit_cast<float>(bits);
    };
    for (int k = 0; k < 10000; ++k) {
        const float value = any_float(), predicted = any_float();
        const float back = with_residual(predicted, residual(value, predicted));
        EXPECT_EQ(std::bit_cast<std::uint32_t>(back), std::bit_cast<std::uint32_t>(value));
    }
    EXPECT_EQ(residual(1.0f, 1.0f), 0u);
    EXPECT_EQ(residual(std::nextafter(1.0f, 2.0f), 1.0f), 2u);
    EXPECT_EQ(residual(1.0f, std::nextafter(1.0f, 2.0f)), 1u);
    EXPECT_LT(residual(1e-44f, -1e-44f), 100u);
}

TEST(Residuals, PlanesAreRead) {
    const std::vector<std::uint32_t> numbers{1u, 0x12345678u, 0xFFFFFFFFu};
    std::string bytes = "x";
    append_planes(numbers, bytes);
    ASSERT_EQ(bytes.size(), 14u);
    EXPECT_EQ(bytes[1], 15);
    EXPECT_EQ(bytes.substr(2, 3), "\x01\x78\xFF");
    std::vector<std::uint32_t> read(3, 7u);
    bytes += "end";
    std::string_view left = std::string_view(bytes).substr(1);
    ASSERT_TRUE(read_planes(left, read));
    EXPECT_EQ(left, "end");
    EXPECT_EQ(read, numbers);
    left = std::string_view(bytes).substr(1, 12);
    EXPECT_FALSE(read_planes(left, read));
}

TEST(Residuals, PlanesOfZerosAreLeftOut) {
    const std::vector<std::uint32_t> numbers{0x00120000u, 0u, 0x00FF0000u};
    std::string bytes;
    append_planes(numbers, bytes);
    EXPECT_EQ(bytes, std::string("\x04\x12\x00\xFF", 4));
    std::vector<std::uint32_t> read(3);
    std::string_view left = bytes;
    ASSERT_TRUE(read_planes(left, read));
    EXPECT_EQ(read, numbers);
}

}  // namespace
}  // namespace gelatin
