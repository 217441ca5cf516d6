// Rows of four floats transposed to columns, one row in each lane. Included once for each instruction set by
// the files that Highway compiles for several (its foreach_target.h), so the guard is a toggle.
#if defined(GELATIN_CPU_SIMD_COLUMNS) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_SIMD_COLUMNS
#undef GELATIN_CPU_SIMD_COLUMNS
#else
#define GELATIN_CPU_SIMD_COLUMNS
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 8>;
using Vector = hn::Vec<Lanes>;
constexpr std::size_t kLanes = hn::MaxLanes(Lanes());
static_assert(kLanes == 1 || kLanes == 4 || kLanes == 8);

// Highway's own Prefetch compiles to nothing in Debian's 1.0.3. Beyond an array's end it is harmless.
template <class T>
HWY_INLINE void prefetch_lanes(const T* first) {
    constexpr std::size_t kLine = 64;  // bytes
    for (std::size_t offset = 0; offset < kLanes * sizeof(T); offset += kLine) {
        __builtin_prefetch(reinterpret_cast<const char*>(first) + offset);
    }
}

// Of a table that is read block by block, so that what comes next is there in time.
template <class Block>
HWY_INLINE void prefetch_block(const Block* block) {
    constexpr std::size_t kAhead = 1024, kLine = 64;  // bytes
    for (std::size_t offset = 0; offset < sizeof(Block); offset += kLine)
        __builtin_prefetch(reinterpret_cast<const char*>(block) + kAhead + offset);
}

struct Columns {
    Vector x, y, z, w;
};

// `row(lane)` points at a row.
template <class D, class Row>
HWY_INLINE Columns load_columns(D d, const Row& row) {
#if HWY_TARGET == HWY_SCALAR
    const float* values = row(0);
    return {hn::Set(d, values[0]), hn::Set(d, values[1]), hn::Set(d, values[2]), hn::Set(d, values[3])};
#else
    Vector a, b, c, e;
    if constexpr (kLanes == 8) {
        const hn::Half<D> half;
        a = hn::Combine(d, hn::LoadU(half, row(4)), hn::LoadU(half, row(0)));
        b = hn::Combine(d, hn::LoadU(half, row(5)), hn::LoadU(half, row(1)));
        c = hn::Combine(d, hn::LoadU(half, row(6)), hn::LoadU(half, row(2)));
        e = hn::Combine(d, hn::LoadU(half, row(7)), hn::LoadU(half, row(3)));
    } else {
        a = hn::LoadU(d, row(0));
        b = hn::LoadU(d, row(1));
        c = hn::LoadU(d, row(2));
        e = hn::LoadU(d, row(3));
    }
    const Vector ac_low = hn::InterleaveLower(d, a, c), be_low = hn::InterleaveLower(d, b, e);
    const Vector ac_high = hn::InterleaveUpper(d, a, c), be_high = hn::InterleaveUpper(d, b, e);
    return {hn::InterleaveLower(d, ac_low, be_low), hn::InterleaveUpper(d, ac_low, be_low),
            hn::InterleaveLower(d, ac_high, be_high), hn::InterleaveUpper(d, ac_high, be_high)};
#endif
}

// For nodes, one in each lane.
HWY_INLINE Columns load_nodes(Lanes d, const float* values, const std::uint32_t* nodes) {
    return load_columns(d, [&](std::size_t l) { return values + 4 * std::size_t(nodes[l]); });
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
