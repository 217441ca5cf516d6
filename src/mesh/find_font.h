#pragma once

#include <filesystem>
#include <string>

namespace gelatin {

/// A face of a font file; collections hold several.
struct FontFile {
    std::filesystem::path file;
    int index = 0;
};

/// Finds an installed font with outlines by a fontconfig pattern ("DejaVu Sans:bold"). If `font` names a file
/// or contains a '/', it is used as a file.
/// @throws InvalidInput if the file is missing, or if no installed font belongs to the pattern's family:
///   fontconfig would silently return another one.
FontFile find_font(const std::string& font);

}  // namespace gelatin
