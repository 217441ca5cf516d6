#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "common/choice.h"
#include "input_options.h"
#include "run_options.h"
#include "viewer/viewer.h"

namespace gelatin {
namespace {

/// The options of `gelatin view`, as written.
struct ViewOptions {
    viewer::ViewerOptions viewer;
    std::string backend = "auto", quality = "auto", size = "1280x720";
};

void view(ViewOptions options) {
    const SceneInput& input = options.viewer.input;
    if (!input.files.empty()) check_input(input);
    options.viewer.backend = parse_backend(options.backend);
    options.viewer.quality = parse_quality(options.quality);
    const PictureSize size = parse_size(options.size);
    options.viewer.width = size.width;
    options.viewer.height = size.height;
    viewer::run_viewer(options.viewer);
}

}  // namespace

void add_view_command(CLI::App& app) {
    auto options = std::make_shared<ViewOptions>();
    CLI::App* command =
        app.add_subcommand("view", "Show a scene, meshes or a recording in a window and interact with them");
    add_input_options(*command, options->viewer.input);
    command
        ->add_option("--backend", options->backend,
                     "auto, gl or cpu; auto is gl on a GPU, but cpu where bodies can meet by contact")
        ->capture_default_str();
    command
        ->add_option("--quality", options->quality,
                     "Of the picture: auto, high or fast; auto is fast on software drivers, else high")
        ->capture_default_str();
    command->add_option("--size", options->size, "Of the window")
        ->type_name("WIDTHxHEIGHT")
        ->capture_default_str();
    command->add_flag("--gl-debug", options->viewer.gl_debug,
                      "Show the OpenGL driver's messages and missing barriers");
    command->callback([options] { view(*options); });
}

}  // namespace gelatin
