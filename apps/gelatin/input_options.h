#pragma once

#include "common/scene_input.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
class Option;
}  // namespace CLI

namespace gelatin {

/// Adds what names a scene, or meshes, and changes it. @returns the option of the files
CLI::Option* add_input_options(CLI::App& command, SceneInput& input);

}  // namespace gelatin
