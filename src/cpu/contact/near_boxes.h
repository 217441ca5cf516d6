#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"

namespace gelatin::cpu {

/// Boxes that are compared at a time.
constexpr std::size_t kBoxBlock = 8;

/// The least and greatest coordinates of boxes, one box in each column.
template <class Real>
struct BoxBlock {
    Real lows[3][kBoxBlock], highs[3][kBoxBlock];  // [m]
};

/// Which boxes of each block meet a box, a bit each; in float with SIMD for the processor it runs on.
/// @param meet output, shape [blocks]
void compare_boxes(std::span<const BoxBlock<float>> blocks, const AxisBox<float>& box,
                   std::span<std::uint8_t> meet);
void compare_boxes(std::span<const BoxBlock<double>> blocks, const AxisBox<double>& box,
                   std::span<std::uint8_t> meet);

/// Faces or edges that others may be near, in ascending order, and their boxes.
template <class Real>
class NearBoxes {
public:
    bool is_empty() const { return indices_.empty(); }
    void clear() {
        indices_.clear();
        blocks_.clear();
    }

    void add(std::uint32_t index, const AxisBox<Real>& box) {
        const std::size_t column = indices_.size() % kBoxBlock;
        if (column == 0) blocks_.push_back(empty_block());
        indices_.push_back(index);
        for (int axis = 0; axis < 3; ++axis) {
            blocks_.back().lows[axis][column] = box.min[axis];
            blocks_.back().highs[axis][column] = box.max[axis];
        }
    }

    /// use(index) for each whose box meets `box`.
    template <class Use>
    void for_meeting(const AxisBox<Real>& box, const Use& use) {
        meet_.resize(blocks_.size());
        compare_boxes(std::span<const BoxBlock<Real>>(blocks_), box, meet_);
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            for (unsigned bits = meet_[b]; bits != 0; bits &= bits - 1)
                use(indices_[kBoxBlock * b + static_cast<std::size_t>(std::countr_zero(bits))]);
        }
    }

private:
    // Of boxes that meet none.
    static BoxBlock<Real> empty_block() {
        BoxBlock<Real> block;
        for (int axis = 0; axis < 3; ++axis) {
            for (std::size_t column = 0; column < kBoxBlock; ++column) {
                block.lows[axis][column] = std::numeric_limits<Real>::infinity();
                block.highs[axis][column] = -std::numeric_limits<Real>::infinity();
            }
        }
        return block;
    }

    std::vector<std::uint32_t> indices_;
    std::vector<BoxBlock<Real>> blocks_;
    std::vector<std::uint8_t> meet_;  // of the box compared last
};

}  // namespace gelatin::cpu
