#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <cstdint>

#include "model/model.h"

namespace gelatin {

/// Calls visit(k) for each k from `first` to before `end`, on several threads where that pays: at least
/// `grain` together.
template <class Visit>
void for_each_index(std::size_t first, std::size_t end, std::size_t grain, const Visit& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(first, end, grain), [&](const auto& range) {
        for (std::size_t k = range.begin(); k != range.end(); ++k) visit(k);
    });
}

/// Calls visit(k) for each k of the range, or below `count`, on several threads where that pays.
template <class Visit>
void for_each_index(const Range& range, const Visit& visit) {
    constexpr std::size_t kGrain = 512;
    for_each_index(range.first, range.end(), kGrain,
                   [&](std::size_t k) { visit(static_cast<std::uint32_t>(k)); });
}
template <class Visit>
void for_each_index(std::size_t count, const Visit& visit) {
    constexpr std::size_t kGrain = 512;
    for_each_index(0, count, kGrain, visit);
}

}  // namespace gelatin
