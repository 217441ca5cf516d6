#pragma once

#include <filesystem>
#include <string>

namespace gelatin {

/// A face of a font file; collections hold several.
struct FontFile {
    std::filesystem::path file;
    int index = 0;
};

/// Finds an installed font with outlines by a fontconfig pattern ("DejaVu Sans:bold"), or takes `font` as a
/// file if it names one or has a '/' in it.
/// @throws InvalidInput if the file is missing, or no installed font is of the pattern's family: fontconfig
/// would give
///   another one without a word.
FontFile find_font(const std::string& font);

}  // namespace gelatin
