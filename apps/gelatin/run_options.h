#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "picture/picture_size.h"
#include "common/scene_input.h"
#include "gelatin/simulator.h"
#include "render/renderer.h"
#include "sim/export.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace gelatin {

/// The options of `gelatin run`; empty paths mean that an output is not requested.
struct RunOptions {
    SceneInput input;
    std::optional<int> frames;

    std::string backend = "auto";
    std::optional<int> device;
    std::optional<int> threads;  ///< of the CPU backend; empty: as many as the machine has
    bool gl_debug = false;

    std::filesystem::path stats, image, video, export_folder;
    std::string export_format = "vtu";
    std::optional<int> every;  ///< frames from one recorded frame to the next
    std::string size = "1280x720";
    std::string quality = "auto";
    std::vector<std::string> overlays;  ///< see overlay_option.h

    std::filesystem::path checkpoint, resume;
    std::optional<int> checkpoint_every;  ///< frames

    bool quiet = false;

    bool draws() const { return !image.empty() || !video.empty(); }
};

void add_run_options(CLI::App& command, RunOptions& options);

/// Refuses outputs that cannot be written, before anything is simulated; creates the export folder.
/// @throws InvalidInput
void check_outputs(const RunOptions& options);

/// @throws InvalidInput for an unknown backend; the other functions for their values.
SimulatorOptions simulator_options(const RunOptions& options);
ExportFormat export_format(const RunOptions& options);
PictureSize picture_size(const RunOptions& options);
render::Quality picture_quality(const RunOptions& options);

/// The values of options of all commands. @throws InvalidInput naming what is allowed
Backend parse_backend(const std::string& text);
PictureSize parse_size(const std::string& text);
render::Quality parse_quality(const std::string& text);

/// Frames from one recorded frame to the next: as requested, or so that a film in real time has about 60
/// pictures per second.
int record_interval(const RunOptions& options, double frame_rate);

}  // namespace gelatin
