#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gelatin::lattice {

/// Disjoint sets of the numbers below `count`, which are joined one pair after the other.
class JoinedSets {
public:
    explicit JoinedSets(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }

    /// The smallest number of the set of `k`.
    std::uint32_t find(std::uint32_t k) {
        while (parents_[k] != k) k = parents_[k] = parents_[parents_[k]];
        return k;
    }

    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a < b)
            parents_[b] = a;
        else
            parents_[a] = b;
    }

private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace gelatin::lattice
