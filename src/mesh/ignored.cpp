#include "mesh/ignored.h"

#include <fmt/core.h>

#include <algorithm>

namespace gelatin {

void Ignored::add(const std::string& what, std::size_t count) {
    if (count == 0) return;
    constexpr std::size_t kMostKinds = 20;  // a file of nonsense has any number of keywords
    const auto known =
        std::find_if(counts_.begin(), counts_.end(), [&](const auto& entry) { return entry.first == what; });
    if (known != counts_.end()) {
        known->second += count;
    } else if (counts_.size() > kMostKinds) {
        counts_.back().second += count;
    } else {
        counts_.emplace_back(counts_.size() < kMostKinds ? what : "others", count);
    }
}

void Ignored::report(Notes& notes) const {
    for (const auto& [what, count] : counts_) notes.push_back(fmt::format("ignored {}: {}", what, count));
}

}  // namespace gelatin
