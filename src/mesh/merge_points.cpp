#include "mesh/merge_points.h"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

namespace gelatin {
namespace {

constexpr std::uint32_t kNoPoint = ~0u;

// The points that are kept, in a grid of cells of a few tolerances, so that a point near to another one is
// found in the cells around it. Kept points are a tolerance apart, so a cell contains few of them for any
// mesh.
class PointGrid {
public:
    PointGrid(const std::vector<glm::dvec3>& positions, const glm::dvec3& origin, double tolerance)
        : positions_(positions), origin_(origin), tolerance_(tolerance), cell_size_(8.0 * tolerance) {
        first_in_cell_.reserve(positions.size());
        next_in_cell_.assign(positions.size(), kNoPoint);
    }

    std::uint32_t find_near(const glm::dvec3& p) const {
        const Cell low = cell_of(p - tolerance_), high = cell_of(p + tolerance_);
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const std::uint32_t found = find_in_cell({x, y, z}, p);
                    if (found != kNoPoint) return found;
                }
            }
        }
        return kNoPoint;
    }

    void add(std::uint32_t vertex) {
        const auto [entry, is_new] = first_in_cell_.try_emplace(hash(cell_of(positions_[vertex])), vertex);
        if (is_new) return;
        next_in_cell_[vertex] = entry->second;
        entry->second = vertex;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const glm::dvec3& p) const {
        if (cell_size_ <= 0.0) return {0, 0, 0};
        const glm::dvec3 cell = floor((p - origin_) / cell_size_);
        return {static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y),
                static_cast<std::int64_t>(cell.z)};
    }

    // Cells with the same hash only cost a few more distances.
    static std::uint64_t hash(const Cell& cell) {
        std::uint64_t h = 0;
        for (const std::int64_t c : cell) {
            h = (h ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u;
            h ^= h >> 29;
        }
        return h;
    }

    std::uint32_t find_in_cell(const Cell& cell, const glm::dvec3& p) const {
        const auto entry = first_in_cell_.find(hash(cell));
        if (entry == first_in_cell_.end()) return kNoPoint;
        for (std::uint32_t v = entry->second; v != kNoPoint; v = next_in_cell_[v]) {
            if (distance(positions_[v], p) <= tolerance_) return v;
        }
        return kNoPoint;
    }

    const std::vector<glm::dvec3>& positions_;
    glm::dvec3 origin_;
    double tolerance_, cell_size_;
    std::unordered_map<std::uint64_t, std::uint32_t> first_in_cell_;
    std::vector<std::uint32_t> next_in_cell_;
};

}  // namespace

MergedPoints merge_points(const std::vector<glm::dvec3>& points, double tolerance) {
    MergedPoints merged;
    if (points.empty()) return merged;
    glm::dvec3 low = points[0], high = low;
    for (const glm::dvec3& p : points) {
        low = min(low, p);
        high = max(high, p);
    }
    PointGrid kept(points, low, tolerance * distance(low, high));
    merged.into.resize(points.size());
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        const std::uint32_t near = kept.find_near(points[v]);
        merged.into[v] = near == kNoPoint ? v : near;
        if (near == kNoPoint) {
            kept.add(v);
        } else {
            ++merged.count;
        }
    }
    return merged;
}

}  // namespace gelatin
