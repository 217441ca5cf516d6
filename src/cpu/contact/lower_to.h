#pragma once

#include <atomic>

namespace gelatin::cpu {

/// Makes `value` the lesser of itself and `least`; by several threads at once, with the same result in any
/// order.
template <class Real>
void lower_to(Real& value, Real least) {
    std::atomic_ref<Real> shared(value);
    Real seen = shared.load(std::memory_order_relaxed);
    while (least < seen && !shared.compare_exchange_weak(seen, least, std::memory_order_relaxed)) {
    }
}

}  // namespace gelatin::cpu
