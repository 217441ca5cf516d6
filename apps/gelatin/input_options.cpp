#include "input_options.h"

#include <CLI/CLI.hpp>
#include <string>

#include "common/choice.h"

namespace gelatin {

CLI::Option* add_input_options(CLI::App& command, SceneInput& input) {
    CLI::Option* files =
        command
            .add_option("FILE", input.files,
                        "A scene file (.toml), meshes that drop onto a floor, surfaces or tets, or a "
                        "recording (.gel)")
            ->type_name("");
    command
        .add_option("--set", input.overrides,
                    "Set a value of the scene: simulation.solver=rk4, object.ball.scale=2")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();

    const char* meshes = "Meshes without a scene";
    command
        .add_option_function<std::string>(
            "--up",
            [&input](const std::string& name) {
                input.meshes.up =
                    choose<Axis>("--up", name, {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}});
            },
            "Which axis of the files points up: x, y or z; by default z for .stl, else y")
        ->type_name("AXIS")
        ->group(meshes);
    command
        .add_flag("--keep-units", input.meshes.keep_units,
                  "Coordinates are metres; otherwise each mesh is scaled to an extent of 1 m")
        ->group(meshes);
    command.add_option("--nodes", input.meshes.nodes, "Of each body, within 20%; 5000 by default")
        ->type_name("N")
        ->group(meshes);
    return files;
}

}  // namespace gelatin
