#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gelatin {

/// The other three corners of a tet, counter-clockwise as seen from a node.
using LinkTriangle = std::array<std::uint32_t, 3>;

/// A vertex that comes in after the three last ones, of which it replaces the oldest or the second oldest.
struct StripStep {
    std::uint32_t vertex;
    bool keeps_oldest;       ///< else the second oldest stays
    std::uint32_t triangle;  ///< that the two that stay make with `vertex`, or kNoTriangle
    bool is_reversed;        ///< they come clockwise

    static constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFu;
};

/// The triangles round a node in an order in which nearly all have an edge in common with the one before: one
/// vertex has to be loaded for each tet, not three. Two vertices come in before the first triangle, and
/// wherever the strip has to begin anew.
std::vector<StripStep> make_link_strip(std::span<const LinkTriangle> triangles);

}  // namespace gelatin
