#pragma once

#include <filesystem>

#include "gelatin/scene.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {

/// The values of the keys "keyframes", "interpolation" and "when_blocked".
std::vector<Keyframe> read_keyframes(TableReader& reader);
Interpolation read_interpolation(TableReader& reader);
WhenBlocked read_when_blocked(TableReader& reader);

/// An [[object.handle]] table, which it finishes. @param folder of the scene's file
HandleDescription read_handle(TableReader reader, const std::filesystem::path& folder);

/// An [[object.load]] or [[rigid.load]] table, which it finishes.
LoadDescription read_load(TableReader reader);

/// The [[attachment]] tables.
std::vector<AttachmentDescription> read_attachments(std::vector<TableReader> tables);

}  // namespace gelatin
