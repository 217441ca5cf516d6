#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <climits>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "common/output_file.h"
#include "common/progress.h"
#include "core/counted.h"
#include "core/log.h"
#include "gelatin/error.h"
#include "gelatin/recording.h"
#include "interrupt.h"
#include "recorder.h"
#include "run_options.h"
#include "whole_number.h"

namespace gelatin {
namespace {

/// The options of `gelatin render` and `gelatin export`.
struct PlayOptions {
    std::filesystem::path recording;
    int from = 0, to = INT_MAX;  // frames
    RunOptions outputs;
};

void add_choice_of_frames(CLI::App& command, PlayOptions& options) {
    command.add_option("RECORDING", options.recording, "What gelatin run --record has written")->required();
    command.add_option("--from", options.from, "First frame")->type_name("FRAME")->check(at_least(0));
    command.add_option("--to", options.to, "Last frame")->type_name("FRAME")->check(at_least(0));
    command.add_flag("--quiet", options.outputs.quiet, "No progress, no summary and no notes");
}

// The indices of the first and the last frame that are asked for.
std::pair<std::size_t, std::size_t> chosen_frames(const PlayOptions& options, const Recording& recording) {
    std::size_t first = 0, end = recording.frame_count();
    while (first < end && recording.frame(first) < options.from) ++first;
    while (end > first && recording.frame(end - 1) > options.to) --end;
    if (first == end)
        throw InvalidInput({options.recording.string(), 0, "--from, --to",
                            fmt::format("{}, {}", options.from, options.to),
                            fmt::format("no such frames are recorded; there are those from {} to {}",
                                        recording.frame(0), recording.frame(recording.frame_count() - 1))});
    return {first, end - 1};
}

// Draws and exports frames of a recording, as `gelatin run` does while it simulates.
void play(const PlayOptions& options) {
    if (options.outputs.quiet) set_up_log(LogLevel::warnings);
    const auto recording = std::make_shared<const Recording>(options.recording);
    const auto [first, last] = chosen_frames(options, *recording);
    if (recording->is_cut_off())
        log_warning(fmt::format("{}: ends within a frame, after frame {}", options.recording.string(),
                                recording->frame(recording->frame_count() - 1)));
    check_outputs(options.outputs);
    Simulator simulator(recording, simulator_options(options.outputs));
    Recorder recorder(options.outputs, simulator);  // camera and light are those of the first of all frames
    simulator.show_recorded(first);
    const Interrupt interrupt;
    Progress progress(simulator.frame(), recording->frame(last), options.outputs.quiet);
    for (std::size_t k = first; k < last && !interrupt.was_asked(); ++k) {
        recorder.record_and_advance();
        progress.update(simulator.frame());
    }
    recorder.record();
    recorder.finish();
    if (simulator.frame() < recording->frame(last))
        throw Error(fmt::format("interrupted after frame {} of {}; what was made until then is written",
                                simulator.frame(), recording->frame(last)));
    if (options.outputs.quiet) return;
    std::FILE* out = message_stream({options.outputs.image, options.outputs.video});
    std::fprintf(out, "%s of %s\n", counted(last - first + 1, "frame").c_str(), options.recording.c_str());
    for (const auto& [what, file] :
         {std::pair("film", options.outputs.video), std::pair("picture", options.outputs.image),
          std::pair("frames", options.outputs.export_folder),
          std::pair("animation", options.outputs.animation)})
        if (!file.empty()) std::fprintf(out, "%s: %s\n", what, file.c_str());
}

}  // namespace

void add_render_command(CLI::App& app) {
    auto options = std::make_shared<PlayOptions>();
    CLI::App* command =
        app.add_subcommand("render", "Draw a recording: a film, a picture, with any overlay; or export it");
    add_choice_of_frames(*command, *options);
    add_output_options(*command, options->outputs);
    command->callback([options] {
        const RunOptions& outputs = options->outputs;
        if (!outputs.draws() && outputs.export_folder.empty() && outputs.animation.empty())
            throw InvalidInput(
                "gelatin render: nothing to make: --video, --image, --export or --animation is needed");
        play(*options);
    });
}

void add_export_command(CLI::App& app) {
    auto options = std::make_shared<PlayOptions>();
    auto out = std::make_shared<std::filesystem::path>();
    CLI::App* command = app.add_subcommand(
        "export", "Write a recording as meshes, one for each frame, or as one animated file");
    add_choice_of_frames(*command, *options);
    command
        ->add_option("OUT", *out,
                     "A folder for the frames; or a file: glTF (.glb), USD (.usda), .pc2 or .mdd")
        ->required();
    command->add_option("--format", options->outputs.export_format, "In a folder: vtu, obj or ply")
        ->capture_default_str();
    command->add_option("--every", options->outputs.every, "Export every K-th frame")
        ->type_name("K")
        ->check(at_least(1));
    command->callback([options, out] {
        const std::vector<std::string>& endings = animation_endings();
        const bool is_file = std::find(endings.begin(), endings.end(), out->extension()) != endings.end();
        (is_file ? options->outputs.animation : options->outputs.export_folder) = *out;
        play(*options);
    });
}

}  // namespace gelatin
