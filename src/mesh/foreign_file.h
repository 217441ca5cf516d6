#pragma once

#include <filesystem>
#include <string_view>

namespace gelatin {

/// Refuses content that is something else than the ending of its file says: another mesh format, a Git LFS
/// pointer, UTF-16, an archive, a web page, ...
/// @param ending of a surface format, in lower case @throws InvalidInput that says what it is
void refuse_foreign_content(const std::filesystem::path& file, std::string_view ending,
                            std::string_view content);

}  // namespace gelatin
