#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "cpu/collision/axis_box.h"

namespace gelatin::cpu {

/// Faces or edges that a leaf of a tree may be near, in ascending order, and their boxes in columns.
template <class Real>
struct NearBoxes {
    static constexpr std::size_t kWord = sizeof(std::uint64_t);  // marks that are looked at together

    std::vector<std::uint32_t> indices;
    std::array<std::vector<Real>, 3> lows, highs;
    std::vector<std::uint8_t> meet;  ///< those of them whose box meets the one compared last

    void clear() {
        indices.clear();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lows[axis].clear();
            highs[axis].clear();
        }
    }

    void add(std::uint32_t index, const AxisBox<Real>& box) {
        indices.push_back(index);
        for (int axis = 0; axis < 3; ++axis) {
            lows[static_cast<std::size_t>(axis)].push_back(box.min[axis]);
            highs[static_cast<std::size_t>(axis)].push_back(box.max[axis]);
        }
    }

    // Without branches and in columns, which compilers turn into SIMD.
    void compare(const AxisBox<Real>& box) {
        const std::size_t count = indices.size();
        meet.assign((count + kWord - 1) / kWord * kWord, 0);
        const Real *low_x = lows[0].data(), *low_y = lows[1].data(), *low_z = lows[2].data();
        const Real *high_x = highs[0].data(), *high_y = highs[1].data(), *high_z = highs[2].data();
        std::uint8_t* const marks = meet.data();
        for (std::size_t k = 0; k < count; ++k) {
            marks[k] = static_cast<std::uint8_t>((low_x[k] <= box.max.x) & (box.min.x <= high_x[k]) &
                                                 (low_y[k] <= box.max.y) & (box.min.y <= high_y[k]) &
                                                 (low_z[k] <= box.max.z) & (box.min.z <= high_z[k]));
        }
    }

    /// use(index) for each whose box meets `box`.
    template <class Use>
    void for_meeting(const AxisBox<Real>& box, const Use& use) {
        compare(box);
        const std::size_t count = indices.size();
        for (std::size_t first = 0; first < count; first += kWord) {
            std::uint64_t word;  // most have none
            std::memcpy(&word, meet.data() + first, kWord);
            if (word == 0) continue;
            for (std::size_t k = first; k < std::min(first + kWord, count); ++k)
                if (meet[k] != 0) use(indices[k]);
        }
    }
};

}  // namespace gelatin::cpu
