#include <fmt/core.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "commands.h"
#include "common/output_file.h"
#include "common/progress.h"
#include "core/counted.h"
#include "core/file.h"
#include "core/log.h"
#include "gelatin/error.h"
#include "interrupt.h"
#include "recorder.h"
#include "run_options.h"
#include "sim/report.h"

namespace gelatin {
namespace {

using Clock = std::chrono::steady_clock;

// How often the state is checked without --stats, so that a simulation that diverged does not run on
// [frames].
constexpr int kCheckInterval = 30;

/// One `gelatin run` from its first frame to its last.
class Run {
public:
    Run(const RunOptions& options, Simulator& simulator)
        : options_(options),
          simulator_(simulator),
          report_(describe_run(simulator)),
          recorder_(options, simulator),
          frames_(simulator.scene().simulation.frames) {}

    /// @throws Diverged, naming the last good checkpoint, after the recordings until then are saved.
    void go();

private:
    void advance();
    void introduce() const;
    void measure();
    void look();
    void take_statistics(std::size_t leave);
    void take_good_statistics();
    std::string tell_last_checkpoint() const;
    void save_checkpoint();
    void finish(bool diverged);
    void print_summary() const;

    const RunOptions& options_;
    Simulator& simulator_;
    RunReport report_;
    Recorder recorder_;
    int frames_;
    std::optional<int> seen_frame_;   // the last one whose statistics were begun
    std::optional<int> saved_frame_;  // of the checkpoint
    bool interrupted_ = false;
};

void Run::go() {
    try {
        advance();
    } catch (const Diverged& error) {
        take_good_statistics();
        finish(true);
        throw Diverged(error.what() + ("; " + tell_last_checkpoint()), error.where());
    }
    finish(false);
    if (interrupted_) {
        throw Error(fmt::format("interrupted after frame {} of {}; what was recorded until then is written",
                                simulator_.frame(), frames_));
    }
}

void Run::advance() {
    const Interrupt interrupt;
    if (!options_.quiet) introduce();
    Progress progress(simulator_.frame(), frames_, options_.quiet);
    const Clock::time_point start = Clock::now();
    Clock::time_point last = start;
    measure();
    while (simulator_.frame() < frames_ && !interrupt.was_asked()) {
        recorder_.record_and_advance();
        measure();
        if (options_.checkpoint_every && simulator_.frame() % *options_.checkpoint_every == 0)
            save_checkpoint();
        const Clock::time_point now = Clock::now();
        report_.frame_ms.push_back(std::chrono::duration<double, std::milli>(now - last).count());
        last = now;
        progress.update(simulator_.frame());
    }
    interrupted_ = simulator_.frame() < frames_;
    recorder_.record();  // the last frame, after which none comes
    look();
    take_statistics(0);  // waits for the device, so that the measured time is complete
    report_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (!options_.checkpoint.empty() && saved_frame_ != simulator_.frame()) save_checkpoint();
}

void Run::introduce() const {
    std::fprintf(stderr, "gelatin: %s, %s, %s; %s of %.4g s per frame; %s on %s\n",
                 counted(report_.counts.nodes, "node").c_str(),
                 counted(report_.counts.springs, "spring").c_str(),
                 counted(report_.counts.faces, "face").c_str(), counted(report_.substeps, "step").c_str(),
                 report_.step_size, report_.backend.c_str(), report_.device.c_str());
}

// The statistics of a frame arrive while the next one is computed.
void Run::measure() {
    if (options_.stats.empty() && simulator_.frame() % kCheckInterval != 0) return;
    look();
    take_statistics(1);
}

void Run::look() {
    if (seen_frame_ == simulator_.frame()) return;
    simulator_.begin_statistics();
    seen_frame_ = simulator_.frame();
}

void Run::take_statistics(std::size_t leave) {
    while (simulator_.pending_statistics() > leave) {
        FrameStatistics statistics = simulator_.take_statistics();
        if (!options_.stats.empty()) report_.frames.push_back(std::move(statistics));
    }
}

// For a run that diverged: the measurements before that.
void Run::take_good_statistics() {
    try {
        take_statistics(0);
    } catch (const Diverged&) {
        return;  // reported already
    }
}

std::string Run::tell_last_checkpoint() const {
    if (saved_frame_) {
        return fmt::format("the last good checkpoint is {} of frame {}", options_.checkpoint.string(),
                           *saved_frame_);
    }
    const std::string start = options_.resume.empty()
                                  ? ""
                                  : fmt::format(" since {}, where the run began", options_.resume.string());
    return fmt::format(
        "no checkpoint was saved{}: --checkpoint FILE --checkpoint-every N saves the last good state "
        "every N frames",
        start);
}

// Only a state that was checked and found valid becomes a checkpoint.
void Run::save_checkpoint() {
    look();
    take_statistics(0);
    simulator_.save_checkpoint(options_.checkpoint);
    saved_frame_ = simulator_.frame();
}

void Run::finish(bool diverged) {
    recorder_.finish();
    if (!options_.stats.empty()) {
        report_.stage_ms = simulator_.take_stage_times();
        write_file(options_.stats, to_json(report_));
    }
    if (!options_.quiet && !diverged) print_summary();
}

void Run::print_summary() const {
    const Counts& counts = report_.counts;
    const std::size_t frames = report_.frame_ms.size();
    std::FILE* out = message_stream({options_.stats, options_.image, options_.video, options_.checkpoint});
    std::fprintf(out, "%s of %s (%s, %s) in %.2f s: %.1f frames/s on %s\n", counted(frames, "frame").c_str(),
                 counted(counts.objects, "object").c_str(), counted(counts.nodes, "node").c_str(),
                 counted(counts.springs, "spring").c_str(), report_.seconds,
                 report_.seconds > 0.0 ? static_cast<double>(frames) / report_.seconds : 0.0,
                 report_.device.c_str());
    const auto report = [out](const char* what, const std::filesystem::path& file) {
        if (!file.empty()) std::fprintf(out, "%s: %s\n", what, file.c_str());
    };
    report("film", options_.video);
    report("picture", options_.image);
    report("frames", options_.export_folder);
    report("animation", options_.animation);
    report("recording", options_.record);
    report("statistics", options_.stats);
    if (saved_frame_) report("checkpoint", options_.checkpoint);
}

// What the run continues from; empty: it begins at the start.
std::filesystem::path start_of(const RunOptions& options) {
    if (!options.resume.empty() || !options.resume_frame) return options.resume;
    if (!is_recording_input(options.input))
        throw InvalidInput({"--resume-frame", 0, {}, {}, "needs --resume, or a recording to simulate"});
    return options.input.files.front();
}

// What the scene is read from.
std::vector<std::filesystem::path> source_files(const RunOptions& options, const Scene& scene) {
    std::vector<std::filesystem::path> files = options.input.files;
    const auto add = [&](const Shape& shape) {
        if (const auto* mesh = std::get_if<FileShape>(&shape)) files.push_back(mesh->file);
    };
    for (const ObjectDescription& object : scene.objects) add(object.shape);
    for (const ColliderDescription& collider : scene.colliders)
        if (const auto* shape = std::get_if<Shape>(&collider.shape)) add(*shape);
    return files;
}

// A file that is read would be lost, and of two outputs one. A checkpoint may go where it came from.
void refuse_to_replace(const RunOptions& options, const Scene& scene) {
    using Output = std::pair<const char*, std::filesystem::path>;
    const std::vector<Output> outputs{{"--stats", options.stats},   {"--image", options.image},
                                      {"--video", options.video},   {"--animation", options.animation},
                                      {"--record", options.record}, {"--checkpoint", options.checkpoint}};
    const std::vector<std::filesystem::path> sources = source_files(options, scene);
    std::error_code error;  // nothing is there yet
    const auto refuse = [](const std::filesystem::path& file, const std::string& problem) {
        throw InvalidInput({file.string(), 0, {}, {}, problem});
    };
    std::map<std::filesystem::path, const char*> options_of;
    for (const auto& [option, file] : outputs) {
        const bool is_no_file =
            std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error);
        if (file.empty() || file == "-" || is_no_file) continue;
        for (const std::filesystem::path& source : sources)
            if (std::filesystem::equivalent(file, source, error))
                refuse(file, fmt::format("is what the run is made from; {} would replace it", option));
        if (file != options.checkpoint && std::filesystem::equivalent(file, options.resume, error))
            refuse(file, fmt::format("is what the run is made from; {} would replace it", option));
        const auto [other, is_new] = options_of.try_emplace(
            std::filesystem::weakly_canonical(std::filesystem::absolute(file), error), option);
        if (!is_new) refuse(file, fmt::format("{} and {} would write the same file", other->second, option));
    }
}

void run(RunOptions options) {
    options.resume = start_of(options);
    if (options.quiet) set_up_log(LogLevel::warnings);
    Scene scene = load_input(options.input);
    if (options.frames) scene.simulation.frames = *options.frames;
    refuse_to_replace(options, scene);
    check_outputs(options);
    std::optional<tbb::global_control> thread_limit;
    if (options.threads) {
        thread_limit.emplace(tbb::global_control::max_allowed_parallelism,
                             static_cast<std::size_t>(*options.threads));
    }
    Simulator simulator(scene, simulator_options(options));
    if (!options.resume.empty()) {
        simulator.load_checkpoint(options.resume, options.resume_frame);
        if (simulator.frame() >= scene.simulation.frames) {
            throw InvalidInput({options.resume.string(),
                                0,
                                {},
                                {},
                                fmt::format("is of frame {}, the run ends at {}: raise --frames",
                                            simulator.frame(), scene.simulation.frames)});
        }
    }
    Run(options, simulator).go();
}

}  // namespace

void add_run_command(CLI::App& app) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command =
        app.add_subcommand("run", "Simulate a scene, or meshes: film them, measure them, export them");
    add_run_options(*command, *options);
    command->callback([options] { run(*options); });
}

}  // namespace gelatin
