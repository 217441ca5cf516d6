#include "mesh/lattice/octree.h"

namespace gelatin::lattice {

bool Octree::contains(const glm::ivec3& p) const {
    const std::int32_t size = cells_[0].size;
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < size && p.y < size && p.z < size;
}

std::uint32_t Octree::find_leaf(const glm::ivec3& p) const {
    std::uint32_t cell = 0;
    while (!cells_[cell].is_leaf()) {
        const glm::ivec3 center = cells_[cell].center();
        cell = cells_[cell].first_child + (p.x >= center.x ? 1 : 0) + (p.y >= center.y ? 2 : 0) +
               (p.z >= center.z ? 4 : 0);
    }
    return cell;
}

void Octree::divide(std::uint32_t leaf) {
    const glm::ivec3 min = cells_[leaf].min;
    const std::int32_t half = cells_[leaf].size / 2;
    cells_[leaf].first_child = static_cast<std::uint32_t>(cells_.size());
    for (int child = 0; child < 8; ++child)
        cells_.push_back({min + half * glm::ivec3(child & 1, child >> 1 & 1, child >> 2), half, 0});
}

// A leaf divides its larger neighbours, which then come to the end of the list and look at theirs.
void Octree::balance() {
    for (std::uint32_t index = 0; index < cells_.size(); ++index) {
        const Cell cell = cells_[index];
        if (!cell.is_leaf()) continue;
        for (int direction = 0; direction < 27; ++direction) {
            const glm::ivec3 d(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
            const int axes = d.x * d.x + d.y * d.y + d.z * d.z;
            if (axes == 0 || axes == 3) continue;  // itself, or over a corner
            const glm::ivec3 beyond = cell.center() + cell.size * d;
            if (!contains(beyond)) continue;
            std::uint32_t neighbour = find_leaf(beyond);
            while (cells_[neighbour].size > 2 * cell.size) {
                divide(neighbour);
                neighbour = find_leaf(beyond);
            }
        }
    }
}

std::uint64_t key_of(const glm::ivec3& p) {
    return static_cast<std::uint64_t>(p.z) << 42 | static_cast<std::uint64_t>(p.y) << 21 |
           static_cast<std::uint64_t>(p.x);
}

glm::ivec3 point_of(std::uint64_t key) {
    constexpr std::uint64_t kMask = (1u << 21) - 1;
    return {static_cast<int>(key & kMask), static_cast<int>(key >> 21 & kMask), static_cast<int>(key >> 42)};
}

}  // namespace gelatin::lattice
