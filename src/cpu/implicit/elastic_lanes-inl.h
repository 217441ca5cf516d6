// Columns of ElasticArrays as lanes. Compiled once for each instruction set, like cpu/simd_columns-inl.h.
#if defined(GELATIN_CPU_ELASTIC_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_ELASTIC_LANES
#undef GELATIN_CPU_ELASTIC_LANES
#else
#define GELATIN_CPU_ELASTIC_LANES
#endif

#include "cpu/elasticity/elements-inl.h"
#include "cpu/implicit/elastic_arrays.h"
#include "cpu/implicit/elastic_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

HWY_INLINE FloatLanes load(Lanes d, const FloatColumn& column, std::uint32_t row) {
    return hn::LoadU(d, &column[row]);
}

HWY_INLINE Vec3Lanes load(Lanes d, const std::array<FloatColumn, 3>& columns, std::uint32_t row) {
    return {load(d, columns[0], row), load(d, columns[1], row), load(d, columns[2], row)};
}

// A spring, linearised: pull is the force by its vector from one end to the other; K has
// stretch stretch^T + across.
struct SpringLanes {
    Vec3Lanes apart, stretch;
    FloatLanes pull, across;

    // A damper over a step makes of a spring another one, as cpu::damped_spring says.
    // @param ends a node of each lane, and the other
    HWY_INLINE SpringLanes(Lanes d, const ElasticStart& start, bool is_damped, const std::uint32_t* first,
                           const std::uint32_t* second, const SpringLaws& laws, std::uint32_t row) {
        const float *positions = &start.positions[0].x, *velocities = &start.velocities[0].x;
        apart = difference(load_nodes(d, positions, second), load_nodes(d, positions, first));
        const FloatLanes inverse = inverse_length<FloatLanes>(apart);
        SpringLaw<FloatLanes> law{load(d, laws.rest_lengths, row), load(d, laws.stiffnesses, row)};
        if (is_damped) {
            const FloatLanes times = FloatLanes(load_nodes(d, velocities, first).w) +
                                     FloatLanes(load_nodes(d, velocities, second).w);
            law =
                damped_spring(law, FloatLanes(1.0f) / inverse, FloatLanes(0.5f * start.inverse_step) * times);
        }
        pull = multiply_add(-(law.stiffness * law.rest_length), inverse, law.stiffness);
        across = larger(pull, FloatLanes(0.0f));
        stretch = (square_root(law.stiffness - across) * inverse) * apart;
    }
};

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
