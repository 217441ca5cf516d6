#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace gelatin {

/// The number of vertices of an OBJ file, and how many of them its faces use.
struct ObjVertices {
    std::size_t count = 0, used = 0;
};

/// Checks what a surface file claims against its content. Assimp, which reads it afterwards, trusts the
/// header's counts, fills missing data with zeros, and does not say which vertex was not finite.
/// @throws InvalidInput naming file, line and field for counts that the file is too short for, a truncated
///   file, coordinates that are not finite, and vertex indices out of range.
ObjVertices check_obj(const std::filesystem::path& file, std::string_view content);
void check_off(const std::filesystem::path& file, std::string_view content);
void check_ply(const std::filesystem::path& file, std::string_view content);
void check_stl(const std::filesystem::path& file, std::string_view content);

/// Size of the binary STL data at the beginning of `content`; 0 if it is text.
/// @throws InvalidInput if it is truncated.
std::size_t binary_stl_size(const std::filesystem::path& file, std::string_view content);

}  // namespace gelatin
