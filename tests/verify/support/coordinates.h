#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace gelatin::test {

/// Of a node among the coordinates of all.
inline Eigen::Index first_coordinate(std::uint32_t node) {
    return 3 * static_cast<Eigen::Index>(node);
}

}  // namespace gelatin::test
