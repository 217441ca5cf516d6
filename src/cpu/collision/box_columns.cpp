// As in advance_nodes_simd.cpp: a box a lane, compiled once for each instruction set.
#include "cpu/collision/box_columns.h"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/collision/box_columns.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/float_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// A box in all lanes, and which of eight columns meet it, a bit each.
class LaneBox {
public:
    HWY_INLINE explicit LaneBox(const AxisBox<float>& box)
        : least_{hn::Set(Lanes(), box.min.x), hn::Set(Lanes(), box.min.y), hn::Set(Lanes(), box.min.z)},
          most_{hn::Set(Lanes(), box.max.x), hn::Set(Lanes(), box.max.y), hn::Set(Lanes(), box.max.z)} {}

    // @param end behind the last column that counts
    HWY_INLINE std::uint32_t meets(const BoxColumns<float>& columns, std::uint32_t first,
                                   std::uint32_t end) const {
        const auto bound = [&](std::size_t k)
                               HWY_ATTR { return hn::LoadU(Lanes(), &columns.bounds()[k][first]); };
        const auto meet = hn::And(hn::And(hn::And(hn::Le(least_[0], bound(3)), hn::Le(bound(0), most_[0])),
                                          hn::And(hn::Le(least_[1], bound(4)), hn::Le(bound(1), most_[1]))),
                                  hn::And(hn::Le(least_[2], bound(5)), hn::Le(bound(2), most_[2])));
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(Lanes(), meet, bits);
        const std::uint32_t left = end - first;
        return left < kLanes ? bits[0] & ((1u << left) - 1u) : bits[0];
    }

private:
    Vector least_[3], most_[3];
};

constexpr auto kStep = static_cast<std::uint32_t>(kLanes);
static_assert(kStep <= BoxColumns<float>::kSpare);

HWY_FLATTEN void find_meeting(std::span<const AxisBox<float>> boxes, const BoxColumns<float>& columns,
                              std::span<const Range> ranges, std::vector<BoxPair>& pairs) {
    for (std::uint32_t b = 0; b < boxes.size(); ++b) {
        const LaneBox box(boxes[b]);
        for (const Range& range : ranges)
            for (std::uint32_t k = range.first; k < range.end(); k += kStep)
                for (std::uint32_t bits = box.meets(columns, k, range.end()); bits != 0; bits &= bits - 1u)
                    pairs.push_back({b, k + static_cast<std::uint32_t>(std::countr_zero(bits))});
    }
}

HWY_FLATTEN bool any_meets(const AxisBox<float>& box, const BoxColumns<float>& columns, std::uint32_t count) {
    const LaneBox lanes(box);
    for (std::uint32_t k = 0; k < count; k += kStep)
        if (lanes.meets(columns, k, count) != 0) return true;
    return false;
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(find_meeting);
HWY_EXPORT(any_meets);

void find_meeting(std::span<const AxisBox<float>> boxes, const BoxColumns<float>& columns,
                  std::span<const Range> ranges, std::vector<BoxPair>& pairs) {
    HWY_DYNAMIC_DISPATCH(find_meeting)(boxes, columns, ranges, pairs);
}

bool any_meets(const AxisBox<float>& box, const BoxColumns<float>& columns, std::uint32_t count) {
    return HWY_DYNAMIC_DISPATCH(any_meets)(box, columns, count);
}

void find_meeting(std::span<const AxisBox<double>> boxes, const BoxColumns<double>& columns,
                  std::span<const Range> ranges, std::vector<BoxPair>& pairs) {
    for (std::uint32_t b = 0; b < boxes.size(); ++b)
        for (const Range& range : ranges)
            for (std::uint32_t k = range.first; k < range.end(); ++k)
                if (meet(boxes[b], columns.at(k))) pairs.push_back({b, k});
}

bool any_meets(const AxisBox<double>& box, const BoxColumns<double>& columns, std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k)
        if (meet(box, columns.at(k))) return true;
    return false;
}

}  // namespace gelatin::cpu
#endif
