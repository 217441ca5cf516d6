#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gelatin::cpu {

/// Sets of numbers below a count, each at first alone in one; the least number of a set names it.
class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }

    std::uint32_t find(std::uint32_t k) {
        while (parents_[k] != k) k = parents_[k] = parents_[parents_[k]];
        return k;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace gelatin::cpu
