#pragma once

#include <filesystem>
#include <string>

#include "gelatin/scene.h"

namespace gelatin {

/// The scene that load_scene makes of a file with this text.
/// @param file in messages; paths in the text are relative to its folder. It need not exist
/// @throws InvalidInput as load_scene does
Scene parse_scene(const std::string& text, const std::filesystem::path& file);

}  // namespace gelatin
