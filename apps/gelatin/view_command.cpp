#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "common/choice.h"
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
    CLI::App* command = app.add_subcommand("view", "Show a scene in a window and interact with it");
    command->add_option("SCENE", options->viewer.scene, "A scene file, or a mesh to drop onto a floor")
        ->type_name("FILE");
    command
        ->add_option("--set", options->viewer.overrides,
                     "Set a value of the scene: simulation.solver=rk4, object.ball.scale=2")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
    command->add_option("--backend", options->backend, "auto, gl or cpu; auto is gl on a GPU")
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
