// As in advance_nodes_simd.cpp: a box a lane, compiled once for each instruction set.
#include "cpu/contact/near_boxes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/contact/near_boxes.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/float_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

HWY_FLATTEN void compare_columns(std::span<const BoxBlock<float>> blocks, const AxisBox<float>& box,
                                 std::span<std::uint8_t> meet) {
    const Lanes d;
    Vector lows[3], highs[3];
    for (int axis = 0; axis < 3; ++axis) {
        lows[axis] = hn::Set(d, box.min[axis]);
        highs[axis] = hn::Set(d, box.max[axis]);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        unsigned bits = 0;
        for (std::size_t first = 0; first < kBoxBlock; first += kLanes) {
            LaneMask meets = hn::Le(hn::LoadU(d, &blocks[b].lows[0][first]), highs[0]);
            meets = hn::And(meets, hn::Le(lows[0], hn::LoadU(d, &blocks[b].highs[0][first])));
            for (int axis = 1; axis < 3; ++axis) {
                meets = hn::And(meets, hn::Le(hn::LoadU(d, &blocks[b].lows[axis][first]), highs[axis]));
                meets = hn::And(meets, hn::Le(lows[axis], hn::LoadU(d, &blocks[b].highs[axis][first])));
            }
            std::uint8_t of_lanes[8];  // as many as StoreMaskBits may write
            hn::StoreMaskBits(d, meets, of_lanes);
            bits |= (of_lanes[0] & ((1u << kLanes) - 1u)) << first;
        }
        meet[b] = static_cast<std::uint8_t>(bits);
    }
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(compare_columns);

void compare_boxes(std::span<const BoxBlock<float>> blocks, const AxisBox<float>& box,
                   std::span<std::uint8_t> meet) {
    HWY_DYNAMIC_DISPATCH(compare_columns)(blocks, box, meet);
}

void compare_boxes(std::span<const BoxBlock<double>> blocks, const AxisBox<double>& box,
                   std::span<std::uint8_t> meet) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        unsigned bits = 0;
        for (std::size_t column = 0; column < kBoxBlock; ++column) {
            bool meets = true;
            for (int axis = 0; axis < 3; ++axis)
                meets = meets && blocks[b].lows[axis][column] <= box.max[axis] &&
                        box.min[axis] <= blocks[b].highs[axis][column];
            bits |= (meets ? 1u : 0u) << column;
        }
        meet[b] = static_cast<std::uint8_t>(bits);
    }
}

}  // namespace gelatin::cpu
#endif
