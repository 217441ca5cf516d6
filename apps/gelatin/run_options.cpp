#include "run_options.h"
#include "whole_number.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/choice.h"
#include "common/output_file.h"
#include "input_options.h"
#include "overlay_option.h"
#include "sim/animation/animation_file.h"

namespace gelatin {
namespace {

constexpr int kLeastSide = 16, kLargestSide = 8192;  // pixels; OpenGL 4.3 guarantees 16384
constexpr double kFilmRate = 60.0;                   // pictures per second

constexpr const char* kOutputs = "Outputs";

}  // namespace

void add_output_options(CLI::App& command, RunOptions& options) {
    command.add_option("--image", options.image, "Draw the last frame; - is stdout")
        ->type_name("FILE.png")
        ->group(kOutputs);
    command.add_option("--video", options.video, "Film the run; in real time without --every")
        ->type_name("FILE.mp4")
        ->group(kOutputs);
    command.add_option("--size", options.size, "Size of image and film in pixels")
        ->type_name("WIDTHxHEIGHT")
        ->capture_default_str()
        ->group(kOutputs);
    command
        .add_option("--quality", options.quality,
                    "Of image and film: auto, high or fast; auto is fast on software drivers, else high")
        ->capture_default_str()
        ->group(kOutputs);
    command
        .add_option(
            "--overlay", options.overlays,
            "Show in image and film: boxes (boxes:3 with three levels of the trees below), faces that touch, "
            "springs by strain (springs:0.02 colours fully at 2%), stretch, stress or speed (stress:2e4 "
            "colours fully at 20 kPa), cut (cut:z, cut:x:0.2, cut:1:0:1), velocity, forces, pressure (of "
            "contacts), objects, wireframe, attachments, bones")
        ->type_name("NAME")
        ->delimiter(',')
        ->expected(1)
        ->take_all()
        ->group(kOutputs);
    CLI::Option* folder =
        command.add_option("--export", options.export_folder, "Write frames as meshes into this folder")
            ->type_name("DIR")
            ->group(kOutputs);
    command.add_option("--format", options.export_format, "Of the exported frames: vtu, obj or ply")
        ->capture_default_str()
        ->needs(folder)
        ->group(kOutputs);
    command
        .add_option("--animation", options.animation,
                    "Write all frames into one file for other programs: glTF (.glb), USD (.usda), or a point "
                    "cache (.pc2, .mdd)")
        ->type_name("FILE")
        ->group(kOutputs);
    command.add_option("--every", options.every, "Film, export and record every K-th frame")
        ->type_name("K")
        ->check(at_least(1))
        ->group(kOutputs);
}

void add_run_options(CLI::App& command, RunOptions& options) {
    add_input_options(command, options.input)->required();
    command
        .add_option("--frames", options.frames, "Run to this frame instead of the scene's simulation.frames")
        ->check(at_least(0));

    const char* computing = "Computing";
    command
        .add_option("--backend", options.backend,
                    "auto, gl or cpu; auto is gl on a GPU, but cpu where bodies can meet by contact")
        ->capture_default_str()
        ->group(computing);
    command
        .add_option("--device", options.device, "Index of the EGL device to use (gelatin info lists them)")
        ->check(at_least(0))
        ->group(computing);
    command.add_option("--threads", options.threads, "Largest number of threads of the CPU backend")
        ->type_name("N")
        ->check(at_least(1))
        ->group(computing);
    command
        .add_flag("--gl-debug", options.gl_debug, "Show the OpenGL driver's messages and missing barriers")
        ->group(computing);

    command
        .add_option("--stats", options.stats, "Write energies, contacts and times to this file; - is stdout")
        ->type_name("FILE.json")
        ->group(kOutputs);
    add_output_options(command, options);
    command
        .add_option("--record", options.record,
                    "Write every frame, or every K-th, to this recording: to draw, export and view it later")
        ->type_name("FILE.gel")
        ->group(kOutputs);
    command.add_flag("--quiet", options.quiet, "No progress, no summary and no notes")->group(kOutputs);

    const char* checkpoints = "Checkpoints";
    CLI::Option* checkpoint =
        command.add_option("--checkpoint", options.checkpoint, "Save the state to this file at the end")
            ->type_name("FILE")
            ->group(checkpoints);
    command.add_option("--checkpoint-every", options.checkpoint_every, "Also save it every N frames")
        ->type_name("N")
        ->check(at_least(1))
        ->needs(checkpoint)
        ->group(checkpoints);
    command.add_option("--resume", options.resume, "Continue from this checkpoint or recording")
        ->type_name("FILE")
        ->group(checkpoints);
    command
        .add_option("--resume-frame", options.resume_frame,
                    "Of the recording, by default its last one; without --resume, of the recording FILE")
        ->check(at_least(0))
        ->group(checkpoints);
}

void check_outputs(const RunOptions& options) {
    if (!options.stats.empty()) check_output_file("--stats", options.stats);
    if (!options.image.empty()) check_output_file("--image", options.image, {".png"});
    if (!options.video.empty()) check_output_file("--video", options.video, {".mp4"});
    if (!options.animation.empty()) check_output_file("--animation", options.animation, animation_endings());
    if (!options.record.empty()) check_output_file("--record", options.record, {".gel"});
    if (!options.checkpoint.empty()) check_output_file("--checkpoint", options.checkpoint);
    export_format(options);
    picture_size(options);
    picture_quality(options);
    parse_overlays(options.overlays);
    if (!options.export_folder.empty()) prepare_export_folder(options.export_folder);
}

SimulatorOptions simulator_options(const RunOptions& options) {
    SimulatorOptions result;
    result.backend = parse_backend(options.backend);
    result.need_gl = options.draws();
    result.gl_debug = options.gl_debug;
    result.gl_device = options.device;
    result.time_stages = result.time_parts = !options.stats.empty();
    return result;
}

ExportFormat export_format(const RunOptions& options) {
    return choose<ExportFormat>(
        "--format", options.export_format,
        {{"vtu", ExportFormat::vtu}, {"obj", ExportFormat::obj}, {"ply", ExportFormat::ply}});
}

PictureSize picture_size(const RunOptions& options) {
    return parse_size(options.size);
}

render::Quality picture_quality(const RunOptions& options) {
    return parse_quality(options.quality);
}

Backend parse_backend(const std::string& text) {
    return choose<Backend>("--backend", text,
                           {{"auto", Backend::automatic}, {"gl", Backend::gl}, {"cpu", Backend::cpu}});
}

PictureSize parse_size(const std::string& text) {
    PictureSize size{0, 0};
    const char* begin = text.data();
    const char* end = begin + text.size();
    const auto [cross, width_status] = std::from_chars(begin, end, size.width);
    const bool has_cross = width_status == std::errc() && cross != end && *cross == 'x';
    if (has_cross && std::from_chars(cross + 1, end, size.height).ptr != end) size.height = 0;
    const auto [least, largest] = std::minmax(size.width, size.height);
    if (!has_cross || least < kLeastSide || largest > kLargestSide) {
        throw InvalidInput(
            {{},
             0,
             "--size",
             text,
             fmt::format("must be WIDTHxHEIGHT with sides from {} to {}", kLeastSide, kLargestSide)});
    }
    return size;
}

render::Quality parse_quality(const std::string& text) {
    using render::Quality;
    return choose<Quality>("--quality", text,
                           {{"auto", Quality::automatic}, {"high", Quality::high}, {"fast", Quality::fast}});
}

int record_interval(const RunOptions& options, double frame_rate) {
    if (options.every) return *options.every;
    return static_cast<int>(std::clamp(std::round(frame_rate / kFilmRate), 1.0, 1e9));
}

}  // namespace gelatin
