#include "mesh/lattice/lattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <utility>

#include "mesh/lattice/overlaps_cube.h"

namespace gelatin::lattice {
namespace {

constexpr std::int32_t kSmallest = 2;  // size of the smallest cell possible, in units

class LatticeMaker {
public:
    LatticeMaker(const EnclosedSpace& space, ThinParts& thin, const CellSizes& sizes)
        : space_(space), thin_(thin), sizes_(sizes), lattice_(make_root(space.tree(), sizes)) {}

    Lattice make() {
        for (const Triangle& face : space_.tree().faces()) divide_along(face, boundary_size());
        divide_thin_parts();
        do {
            octree().balance();
            check_count();
            make_tets();
        } while (divide_by_signs());
        return std::move(lattice_);
    }

private:
    std::int32_t boundary_size() const { return kSmallest << sizes_.finer_levels; }
    Octree& octree() { return lattice_.octree; }

    // The octree covers the surface with a margin. Symmetric surfaces do not meet the lattice's planes.
    static Lattice make_root(const FaceTree& tree, const CellSizes& sizes) {
        constexpr std::int32_t kLargest = 1 << 20;  // of key_of
        const BoxNode& all = tree.nodes()[0];
        const double unit = smallest_cell(sizes) / kSmallest;
        const glm::dvec3 extent = all.max - all.min;
        const double needed = (std::max({extent.x, extent.y, extent.z}) + 3.0 * sizes.boundary) / unit;
        if (needed > kLargest) throw TooManyCells();
        const auto size =
            static_cast<std::int32_t>(std::bit_ceil(static_cast<std::uint32_t>(std::ceil(needed))));
        const glm::dvec3 margin = sizes.boundary * glm::dvec3(1.137, 1.291, 1.413);
        return {all.min - margin, unit, Octree(size), {}, {}};
    }

    void check_count() {
        if (octree().cells().size() > sizes_.most_cells) throw TooManyCells();
    }

    // Divides the cells that the face passes through down to `size`.
    void divide_along(const Triangle& face, std::int32_t size) {
        const auto coordinates = [&](const glm::dvec3& p) { return (p - lattice_.origin) / lattice_.unit; };
        constexpr double kSlack = 1e-3;  // of a unit
        const glm::dvec3 low = coordinates(glm::min(glm::min(face[0], face[1]), face[2])) - kSlack;
        const glm::dvec3 high = coordinates(glm::max(glm::max(face[0], face[1]), face[2])) + kSlack;
        stack_.assign(1, 0);
        while (!stack_.empty()) {
            const std::uint32_t index = stack_.back();
            stack_.pop_back();
            const Octree::Cell cell = octree()[index];
            if (cell.size <= size || glm::any(glm::lessThan(glm::dvec3(cell.max()), low)) ||
                glm::any(glm::greaterThan(glm::dvec3(cell.min), high)))
                continue;
            const glm::dvec3 center = lattice_.position(cell.center());
            if (!overlaps_cube(face, center, 0.5 * cell.size * lattice_.unit)) continue;
            if (cell.is_leaf()) octree().divide(index);
            const std::uint32_t first = octree()[index].first_child;
            for (std::uint32_t child = 0; child < 8; ++child) stack_.push_back(first + child);
        }
        check_count();
    }

    void divide_thin_parts() {
        if (sizes_.finer_levels == 0) return;
        for (const ThinPlace& place : thin_.find(sizes_.boundary / kCellsInThickness, sizes_.boundary)) {
            std::int32_t size = boundary_size();
            while (size > kSmallest && size * lattice_.unit > kCellsInThickness * place.thickness) size /= 2;
            divide_along(place.face, size);
        }
    }

    // Looks up which points are inside, of those that are new.
    void make_tets() {
        const std::vector<std::uint64_t> known = std::move(lattice_.tets.points);
        const std::vector<std::uint8_t> known_inside = std::move(lattice_.inside);
        lattice_.tets = make_lattice_tets(octree());
        const std::vector<std::uint64_t>& points = lattice_.tets.points;
        lattice_.inside.resize(points.size());
        tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t p) {
            const auto found = std::lower_bound(known.begin(), known.end(), points[p]);
            const bool is_known = found != known.end() && *found == points[p];
            lattice_.inside[p] = is_known ? known_inside[static_cast<std::size_t>(found - known.begin())]
                                          : space_.contains(lattice_.position(point_of(points[p])));
        });
        const auto count = std::accumulate(lattice_.inside.begin(), lattice_.inside.end(), std::size_t{0});
        if (count > sizes_.most_inside) throw TooManyCells();
    }

    // Divides cells that are too large where the boundary passes through a tet, as it does in holes of the
    // surface, and cells that are too large for the inside. Returns whether there were any.
    bool divide_by_signs() {
        std::vector<std::uint32_t> large;
        const std::int32_t largest = boundary_size() << sizes_.coarser_levels;
        for (std::size_t t = 0; t < lattice_.tets.tets.size(); ++t) {
            int count = 0;
            for (const std::uint32_t point : lattice_.tets.tets[t]) count += lattice_.inside[point];
            if (count == 0) continue;
            const std::int32_t allowed = count == 4 ? largest : boundary_size();
            for (const std::uint32_t cell : lattice_.tets.cells[t]) {
                if (octree()[cell].size > allowed) large.push_back(cell);
            }
        }
        std::sort(large.begin(), large.end());
        large.erase(std::unique(large.begin(), large.end()), large.end());
        for (const std::uint32_t cell : large) octree().divide(cell);
        return !large.empty();
    }

    const EnclosedSpace& space_;
    ThinParts& thin_;
    const CellSizes sizes_;
    Lattice lattice_;
    std::vector<std::uint32_t> stack_;
};

}  // namespace

double smallest_cell(const CellSizes& sizes) {
    return std::ldexp(sizes.boundary, -sizes.finer_levels);
}

Lattice make_lattice(const EnclosedSpace& space, ThinParts& thin, const CellSizes& sizes) {
    return LatticeMaker(space, thin, sizes).make();
}

}  // namespace gelatin::lattice
