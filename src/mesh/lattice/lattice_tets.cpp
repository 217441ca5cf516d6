#include "mesh/lattice/lattice_tets.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

namespace gelatin::lattice {
namespace {

using Corners = std::array<glm::ivec3, 4>;

// Keys of the corners and centres of all leaves.
std::vector<std::uint64_t> collect_points(const Octree& octree) {
    std::vector<std::uint64_t> points;
    for (const Octree::Cell& cell : octree.cells()) {
        if (!cell.is_leaf()) continue;
        points.push_back(key_of(cell.center()));
        for (int corner = 0; corner < 8; ++corner)
            points.push_back(
                key_of(cell.min + cell.size * glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2)));
    }
    tbb::parallel_sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

/// Adds tets of one octree to `out`, each for one of its leaves.
class TetMaker {
public:
    TetMaker(const Octree& octree, const std::vector<std::uint64_t>& points, LatticeTets& out)
        : octree_(octree), points_(points), out_(out) {}

    void add_cell(std::uint32_t index) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const int side : {-1, 1}) add_face(index, axis, side);
        }
    }

private:
    void add_face(std::uint32_t index, int axis, int side) {
        const Octree::Cell& cell = octree_[index];
        glm::ivec3 normal(0), u(0), v(0);
        normal[axis] = side;
        u[(axis + 1) % 3] = cell.size / 2;
        v[(axis + 2) % 3] = cell.size / 2;
        const glm::ivec3 face = cell.center() + cell.size / 2 * normal;  // its centre
        const glm::ivec3 beyond = face + (side > 0 ? glm::ivec3(0) : normal);
        if (!octree_.contains(beyond)) return;
        const std::uint32_t other = octree_.find_leaf(beyond);
        const Octree::Cell& neighbour = octree_[other];
        if (neighbour.size == cell.size) {
            if (side > 0) add_equal(index, other, face, u, v, axis);
        } else if (neighbour.size < cell.size) {
            add_quarters(index, other, face, u, v);
        } else {
            add_half_pyramids(index, other, axis, face, u, v);
        }
    }

    // Around the line between the centres of two cells of one size: a tet for each edge of their common face,
    // or two where that edge has a midpoint.
    void add_equal(std::uint32_t index, std::uint32_t other, const glm::ivec3& face, const glm::ivec3& u,
                   const glm::ivec3& v, int axis) {
        const glm::ivec3 a = octree_[index].center(), b = octree_[other].center();
        const std::array<glm::ivec3, 5> ring = {face - u - v, face + u - v, face + u + v, face - u + v,
                                                face - u - v};
        for (int k = 0; k < 4; ++k) {
            const glm::ivec3 middle = (ring[k] + ring[k + 1]) / 2;
            if (is_divided(middle, face, axis, octree_[index].size)) {
                add({a, b, ring[k], middle}, index, other);
                add({a, b, middle, ring[k + 1]}, index, other);
            } else {
                add({a, b, ring[k], ring[k + 1]}, index, other);
            }
        }
    }

    // Is one of the other two cells around the edge smaller?
    bool is_divided(const glm::ivec3& middle, const glm::ivec3& face, int axis, std::int32_t size) const {
        glm::ivec3 outward = middle - face;
        for (int k = 0; k < 3; ++k) outward[k] = outward[k] > 0 ? 0 : outward[k] < 0 ? -1 : 0;
        for (const int side : {-1, 0}) {
            glm::ivec3 p = middle + outward;
            p[axis] += side;
            if (octree_.contains(p) && octree_[octree_.find_leaf(p)].size < size) return true;
        }
        return false;
    }

    // The neighbours are smaller: eight tets around the centre of the face.
    void add_quarters(std::uint32_t index, std::uint32_t other, const glm::ivec3& face, const glm::ivec3& u,
                      const glm::ivec3& v) {
        const glm::ivec3 center = octree_[index].center();
        const std::array<glm::ivec3, 9> ring = {face - u - v, face - v,     face + u - v,
                                                face + u,     face + u + v, face + v,
                                                face - u + v, face - u,     face - u - v};
        for (int k = 0; k < 8; ++k) add({center, face, ring[k], ring[k + 1]}, index, other);
    }

    // The neighbour is larger: a pyramid, divided along the diagonal that meets the centre of the neighbour's
    // face.
    void add_half_pyramids(std::uint32_t index, std::uint32_t other, int axis, const glm::ivec3& face,
                           const glm::ivec3& u, const glm::ivec3& v) {
        glm::ivec3 hub = octree_[other].center();
        hub[axis] = face[axis];
        const glm::ivec3 corner = 2 * face - hub, center = octree_[index].center();
        const glm::ivec3 along = hub - face;  // to the hub, by components of u and v
        const glm::ivec3 first =
            face + u * (along[axis_of(u)] > 0 ? 1 : -1) - v * (along[axis_of(v)] > 0 ? 1 : -1);
        const glm::ivec3 second = 2 * face - first;
        add({center, hub, corner, first}, index, other);
        add({center, hub, corner, second}, index, other);
    }

    static int axis_of(const glm::ivec3& d) { return d.x != 0 ? 0 : d.y != 0 ? 1 : 2; }

    void add(const Corners& corners, std::uint32_t index, std::uint32_t other) {
        std::array<std::uint32_t, 4>& tet = out_.tets.emplace_back();
        for (int k = 0; k < 4; ++k) {
            const auto found = std::lower_bound(points_.begin(), points_.end(), key_of(corners[k]));
            tet[k] = static_cast<std::uint32_t>(found - points_.begin());
        }
        out_.cells.push_back({index, other});
    }

    const Octree& octree_;
    const std::vector<std::uint64_t>& points_;
    LatticeTets& out_;
};

}  // namespace

LatticeTets make_lattice_tets(const Octree& octree) {
    constexpr std::size_t kBlock = 2048;  // cells
    LatticeTets lattice;
    lattice.points = collect_points(octree);
    const std::size_t blocks = (octree.cells().size() + kBlock - 1) / kBlock;
    std::vector<LatticeTets> parts(blocks);
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
        TetMaker maker(octree, lattice.points, parts[b]);
        const std::size_t end = std::min((b + 1) * kBlock, octree.cells().size());
        for (std::size_t cell = b * kBlock; cell < end; ++cell) {
            if (octree.cells()[cell].is_leaf()) maker.add_cell(static_cast<std::uint32_t>(cell));
        }
    });
    for (LatticeTets& part : parts) {
        lattice.tets.insert(lattice.tets.end(), part.tets.begin(), part.tets.end());
        lattice.cells.insert(lattice.cells.end(), part.cells.begin(), part.cells.end());
        part = {};
    }
    return lattice;
}

}  // namespace gelatin::lattice
