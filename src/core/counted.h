#pragma once

#include <cstddef>
#include <string>

namespace gelatin {

/// "1 thread", "2 threads". @param noun one that takes an s in the plural
inline std::string counted(std::size_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace gelatin
