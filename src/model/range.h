#pragma once

#include <cstdint>

namespace gelatin {

struct Range {
    std::uint32_t first = 0;
    std::uint32_t count = 0;

    std::uint32_t end() const { return first + count; }
};

}  // namespace gelatin
