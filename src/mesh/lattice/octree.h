#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace gelatin::lattice {

/// A cube that is divided into eight, again and again. Coordinates are integers in halves of the smallest
/// cell possible, so that corners, centres and midpoints of edges of all cells have such coordinates.
class Octree {
public:
    struct Cell {
        glm::ivec3 min;
        std::int32_t size;          ///< of an edge, even
        std::uint32_t first_child;  ///< of eight, by x + 2 y + 4 z; 0: not divided
        bool is_leaf() const { return first_child == 0; }
        glm::ivec3 center() const { return min + size / 2; }
        glm::ivec3 max() const { return min + size; }
    };

    /// One cell of `size`, a power of two.
    explicit Octree(std::int32_t size) : cells_{{glm::ivec3(0), size, 0}} {}

    const std::vector<Cell>& cells() const { return cells_; }  ///< parents before their children
    const Cell& operator[](std::uint32_t cell) const { return cells_[cell]; }
    bool contains(const glm::ivec3& p) const;

    /// The leaf with p in [min, max). @pre contains(p)
    std::uint32_t find_leaf(const glm::ivec3& p) const;
    void divide(std::uint32_t leaf);

    /// Divides leaves until those that share a face or an edge differ in size by a factor of two at most.
    void balance();

private:
    std::vector<Cell> cells_;
};

/// The coordinates of a lattice point as one number, which sorts them.
std::uint64_t key_of(const glm::ivec3& p);
glm::ivec3 point_of(std::uint64_t key);

}  // namespace gelatin::lattice
