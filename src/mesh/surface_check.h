#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace gelatin {

/// How many vertices an OBJ file has, and how many of them its faces use.
struct ObjVertices {
    std::size_t count = 0, used = 0;
};

/// Holds what a surface file claims against what it has. Assimp, which reads it afterwards, believes the
/// header's counts, fills what is cut off with zeros, and does not know which vertex was not finite.
/// @throws InvalidInput naming file, line and field for counts that the file is too short for, a file that is
///   cut off, coordinates that are not finite, and vertex indices out of range.
ObjVertices check_obj(const std::filesystem::path& file, std::string_view content);
void check_off(const std::filesystem::path& file, std::string_view content);
void check_ply(const std::filesystem::path& file, std::string_view content);
void check_stl(const std::filesystem::path& file, std::string_view content);

/// Size of the binary STL data at the beginning of `content`; 0 if it is text.
/// @throws InvalidInput if it is cut off.
std::size_t binary_stl_size(const std::filesystem::path& file, std::string_view content);

}  // namespace gelatin
