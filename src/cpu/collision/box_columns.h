#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "model/range.h"

namespace gelatin::cpu {

/// Boxes, a column for each bound, so that one box is compared with several at a time.
template <class Real>
class BoxColumns {
public:
    /// Boxes that may be read behind the last one.
    static constexpr std::size_t kSpare = 16;

    BoxColumns() : BoxColumns(0) {}
    explicit BoxColumns(std::size_t count) { resize(count); }
    std::uint32_t size() const { return count_; }
    void resize(std::size_t count) {
        count_ = static_cast<std::uint32_t>(count);
        for (std::vector<Real>& bounds : bounds_) bounds.resize(count + kSpare);
    }
    void add(const AxisBox<Real>& box) {
        resize(count_ + 1);
        set(count_ - 1, box);
    }
    void set(std::size_t k, const AxisBox<Real>& box) {
        for (int axis = 0; axis < 3; ++axis) {
            bounds_[static_cast<std::size_t>(axis)][k] = box.min[axis];
            bounds_[static_cast<std::size_t>(axis) + 3][k] = box.max[axis];
        }
    }
    AxisBox<Real> at(std::size_t k) const {
        return {{bounds_[0][k], bounds_[1][k], bounds_[2][k]}, {bounds_[3][k], bounds_[4][k], bounds_[5][k]}};
    }
    /// Lower bounds of x, y, z, then upper ones.
    const std::array<std::vector<Real>, 6>& bounds() const { return bounds_; }

private:
    std::uint32_t count_ = 0;
    std::array<std::vector<Real>, 6> bounds_;
};

/// Of two lists.
struct BoxPair {
    std::uint32_t first, second;
    bool operator==(const BoxPair&) const = default;
};

/// Appends all pairs of boxes that meet(): of `boxes`, and of columns in some ranges; in the order of both.
/// In float with SIMD for the processor it runs on.
void find_meeting(std::span<const AxisBox<float>> boxes, const BoxColumns<float>& columns,
                  std::span<const Range> ranges, std::vector<BoxPair>& pairs);
void find_meeting(std::span<const AxisBox<double>> boxes, const BoxColumns<double>& columns,
                  std::span<const Range> ranges, std::vector<BoxPair>& pairs);

/// Whether any of the first columns meets a box.
bool any_meets(const AxisBox<float>& box, const BoxColumns<float>& columns, std::uint32_t count);
bool any_meets(const AxisBox<double>& box, const BoxColumns<double>& columns, std::uint32_t count);

}  // namespace gelatin::cpu
