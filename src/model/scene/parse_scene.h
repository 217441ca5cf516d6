#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin {

/// The scene that load_scene makes of a file with this text.
/// @param file in messages; paths in the text are relative to its folder. It need not exist
/// @throws InvalidInput as load_scene does
Scene parse_scene(const std::string& text, const std::filesystem::path& file);

/// The [[attachment]] tables of a text that has nothing else, unchecked.
/// @throws InvalidInput if it has, or values are of other types
std::vector<AttachmentDescription> parse_attachments(const std::string& text);

}  // namespace gelatin
