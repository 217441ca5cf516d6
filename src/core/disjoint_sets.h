#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gelatin {

/// Sets of numbers that are united step by step. The least number of each stands for it.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }

    /// The least number in the set of `k`.
    std::uint32_t least(std::uint32_t k) {
        while (parents_[k] != k) k = parents_[k] = parents_[parents_[k]];
        return k;
    }

    /// @return whether they were in different sets
    bool unite(std::uint32_t a, std::uint32_t b) {
        a = least(a);
        b = least(b);
        parents_[std::max(a, b)] = std::min(a, b);
        return a != b;
    }

private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace gelatin
