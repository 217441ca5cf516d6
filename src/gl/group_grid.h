#pragma once

#include <algorithm>
#include <cstddef>

namespace gelatin::gl {

/// What OpenGL promises for each dimension of a dispatch; more fails without a word on some drivers.
inline constexpr std::size_t kMostGroups = 65'535;

/// Work groups in two dimensions, since one may not be enough for them.
struct GroupGrid {
    explicit GroupGrid(std::size_t groups)
        : rows(std::max<std::size_t>((groups + kMostGroups - 1) / kMostGroups, 1)),
          columns((groups + rows - 1) / rows) {}

    std::size_t rows;
    std::size_t columns;  ///< rows of equal length leave fewer groups over than full rows and a rest
};

}  // namespace gelatin::gl
