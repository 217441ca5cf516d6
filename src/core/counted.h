#pragma once

#include <concepts>
#include <string>

namespace gelatin {

/// "1 thread", "2 threads"; "1 vertex", "2 vertices".
/// @param plural of a noun that takes more than an s
inline std::string counted(std::integral auto count, const std::string& noun,
                           const std::string& plural = {}) {
    if (count != 1 && !plural.empty()) return std::to_string(count) + " " + plural;
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace gelatin
