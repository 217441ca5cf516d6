// A spring in each lane; compiled once for each instruction set.
#include "cpu/elasticity/spring_energies.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/elasticity/spring_energies.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/elasticity/elements-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// Of whole lanes.
double sum_energies(const Spring* springs, std::size_t count, const glm::vec4* positions) {
    const Lanes d;
    const hn::CappedTag<double, kLanes> dd;
    const hn::Rebind<float, decltype(dd)> df;  // as many floats as doubles at a time
    auto sum = hn::Zero(dd);
    for (std::size_t s = 0; s < count; s += kLanes) {
        const Spring* own = springs + s;
        const Columns from = load_columns(d, [&](std::size_t l) { return &positions[own[l].i].x; });
        const Columns to = load_columns(d, [&](std::size_t l) { return &positions[own[l].j].x; });
        HWY_ALIGN float rest_lengths[kLanes], stiffnesses[kLanes], energies[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l) {
            rest_lengths[l] = own[l].rest_length;
            stiffnesses[l] = own[l].stiffness;
        }
        const SpringLaw<FloatLanes> law{hn::Load(d, rest_lengths), hn::Load(d, stiffnesses)};
        hn::Store(spring_energy(difference(to, from), law).v, d, energies);
        for (std::size_t l = 0; l < kLanes; l += hn::MaxLanes(dd))
            sum = hn::Add(sum, hn::PromoteTo(dd, hn::Load(df, energies + l)));
    }
    return hn::GetLane(hn::SumOfLanes(dd, sum));
}

std::size_t lane_count() {
    return kLanes;
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"

namespace gelatin::cpu {

HWY_EXPORT(sum_energies);
HWY_EXPORT(lane_count);

double sum_spring_energies(std::span<const Spring> springs, const glm::dvec4* positions) {
    double sum = 0.0;
    for (const Spring& spring : springs) {
        const SpringLaw<double> law{static_cast<double>(spring.rest_length),
                                    static_cast<double>(spring.stiffness)};
        sum += spring_energy(glm::dvec3(positions[spring.j]) - glm::dvec3(positions[spring.i]), law);
    }
    return sum;
}

double sum_spring_energies(std::span<const Spring> springs, const glm::vec4* positions) {
    const std::size_t whole =
        springs.size() / HWY_DYNAMIC_DISPATCH(lane_count)() * HWY_DYNAMIC_DISPATCH(lane_count)();
    double sum = HWY_DYNAMIC_DISPATCH(sum_energies)(springs.data(), whole, positions);
    for (const Spring& spring : springs.subspan(whole))
        sum +=
            static_cast<double>(spring_energy(glm::vec3(positions[spring.j]) - glm::vec3(positions[spring.i]),
                                              SpringLaw<float>{spring.rest_length, spring.stiffness}));
    return sum;
}

}  // namespace gelatin::cpu
#endif
