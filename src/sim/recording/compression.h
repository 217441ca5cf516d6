#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gelatin {

/// Bytes as a zstd frame, which knows their number. @param level of zstd
/// @param has_far_copies whether equal bytes may be far from each other: looks for them in the last 128 MiB
std::string compressed(const std::string& bytes, int level, bool has_far_copies = false);

/// @param most bytes that there can be
/// @throws InvalidInput without a file's name, if they are not such a frame or more
std::string decompressed(std::string_view bytes, std::size_t most);

}  // namespace gelatin
