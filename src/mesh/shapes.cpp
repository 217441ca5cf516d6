#include "mesh/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

namespace gelatin {

namespace {

constexpr double kGolden = std::numbers::phi;
constexpr double kIcosahedronVertices[12][3] = {{-1, kGolden, 0},  {1, kGolden, 0},   {-1, -kGolden, 0},
                                                {1, -kGolden, 0},  {0, -1, kGolden},  {0, 1, kGolden},
                                                {0, -1, -kGolden}, {0, 1, -kGolden},  {kGolden, 0, -1},
                                                {kGolden, 0, 1},   {-kGolden, 0, -1}, {-kGolden, 0, 1}};
constexpr int kIcosahedronFaces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                          {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                          {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                          {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};

/// Gives each distinct key one vertex, created when the key first occurs.
template <class Key>
class VertexByKey {
public:
    explicit VertexByKey(SurfaceMesh& mesh) : mesh_(mesh) {}

    template <class MakePosition>
    std::uint32_t get(const Key& key, const MakePosition& make_position) {
        const auto [entry, is_new] =
            vertices_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (is_new) mesh_.positions.push_back(make_position());
        return entry->second;
    }

private:
    SurfaceMesh& mesh_;
    std::map<Key, std::uint32_t> vertices_;
};

/// A horizontal ring of a capsule's vertices: `per_quadrant` in each quadrant, or the single one of a pole.
struct Ring {
    std::uint32_t first, per_quadrant;

    std::uint32_t vertex(std::uint32_t quadrant, std::uint32_t k) const {
        return per_quadrant == 0 ? first : first + (quadrant * per_quadrant + k) % (4 * per_quadrant);
    }
};

/// @param polar_angle from the +y axis [rad]; @param center_y of the half sphere that the ring is on [m]
Ring add_ring(SurfaceMesh& mesh, double radius, double polar_angle, double center_y,
              std::uint32_t per_quadrant) {
    const Ring ring{static_cast<std::uint32_t>(mesh.positions.size()), per_quadrant};
    const double y = center_y + radius * std::cos(polar_angle);
    if (per_quadrant == 0) {
        mesh.positions.emplace_back(0.0, y, 0.0);
        return ring;
    }
    for (std::uint32_t k = 0; k < 4 * per_quadrant; ++k) {
        const double turn = 0.5 * std::numbers::pi * k / per_quadrant;
        const double distance = radius * std::sin(polar_angle);
        mesh.positions.emplace_back(distance * std::sin(turn), y, distance * std::cos(turn));
    }
    return ring;
}

/// Fills the band between two rings. The larger one has as many vertices in a quadrant as the smaller, or one
/// more.
void add_band(SurfaceMesh& mesh, const Ring& smaller, const Ring& larger, bool smaller_is_above) {
    const auto add_face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (!smaller_is_above) std::swap(b, c);
        mesh.faces.emplace_back(a, b, c);
    };
    for (std::uint32_t quadrant = 0; quadrant < 4; ++quadrant) {
        for (std::uint32_t k = 0; k < larger.per_quadrant; ++k) {
            const std::uint32_t corner = smaller.vertex(quadrant, k), next = larger.vertex(quadrant, k + 1);
            add_face(corner, larger.vertex(quadrant, k), next);
            if (k < smaller.per_quadrant) add_face(corner, next, smaller.vertex(quadrant, k + 1));
        }
    }
}

}  // namespace

SurfaceMesh make_sphere(const SphereShape& shape) {
    SurfaceMesh mesh;
    const int n = shape.frequency;
    // A vertex is identified by its weights on the icosahedron's vertices, in `n`ths: at most three are not
    // zero.
    VertexByKey<std::array<std::pair<int, int>, 3>> vertices(mesh);

    for (const auto& corners : kIcosahedronFaces) {
        const auto vertex = [&](int i, int j) {
            const int weights[3] = {n - i - j, i, j};
            std::array<std::pair<int, int>, 3> key;
            for (int k = 0; k < 3; ++k) key[k] = {weights[k] == 0 ? -1 : corners[k], weights[k]};
            std::sort(key.begin(), key.end());
            return vertices.get(key, [&] {
                glm::dvec3 sum(0.0);
                for (const auto& [corner, weight] : key) {
                    if (weight == 0) continue;
                    const auto& p = kIcosahedronVertices[corner];
                    sum += double(weight) * glm::dvec3(p[0], p[1], p[2]);
                }
                return shape.radius * glm::normalize(sum);
            });
        };
        for (int i = 0; i < n; ++i) {
            for (int j = 0; i + j < n; ++j) {
                mesh.faces.emplace_back(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
                if (i + j + 1 == n) continue;
                mesh.faces.emplace_back(vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
            }
        }
    }
    return mesh;
}

SurfaceMesh make_box(const BoxShape& shape) {
    SurfaceMesh mesh;
    VertexByKey<std::array<int, 3>> vertices(mesh);
    const auto vertex = [&](const glm::ivec3& at) {
        return vertices.get({at.x, at.y, at.z},
                            [&] { return shape.size * (glm::dvec3(at) / glm::dvec3(shape.segments) - 0.5); });
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const int side : {0, shape.segments[axis]}) {
            for (int i = 0; i < shape.segments[u]; ++i) {
                for (int j = 0; j < shape.segments[v]; ++j) {
                    std::uint32_t corners[4];  // counter-clockwise seen from +axis
                    for (int k = 0; k < 4; ++k) {
                        glm::ivec3 at(0);
                        at[axis] = side;
                        at[u] = i + (k == 1 || k == 2);
                        at[v] = j + (k >= 2);
                        corners[k] = vertex(at);
                    }
                    if (side == 0) std::swap(corners[1], corners[3]);
                    const int turn = (i + j) % 2;  // diagonals alternate, so that no direction is stiffer
                    mesh.faces.emplace_back(corners[turn], corners[turn + 1], corners[turn + 2]);
                    mesh.faces.emplace_back(corners[turn], corners[turn + 2], corners[(turn + 3) % 4]);
                }
            }
        }
    }
    return mesh;
}

SurfaceMesh make_capsule(const CapsuleShape& shape) {
    SurfaceMesh mesh;
    const auto quarter_rings = static_cast<std::uint32_t>(shape.frequency);
    const double ring_angle = 0.5 * std::numbers::pi / shape.frequency;
    const int bands = std::max(1, static_cast<int>(std::lround(shape.length / (shape.radius * ring_angle))));

    // Ring k has k vertices in each quadrant. This gives evenly sized triangles, where meridians would be
    // crowded at the poles.
    Ring previous = add_ring(mesh, shape.radius, 0.0, 0.5 * shape.length, 0);
    for (std::uint32_t k = 1; k <= quarter_rings; ++k) {
        const Ring ring = add_ring(mesh, shape.radius, k * ring_angle, 0.5 * shape.length, k);
        add_band(mesh, previous, ring, true);
        previous = ring;
    }
    for (int band = 1; band <= bands; ++band) {
        const double center_y = (0.5 - double(band) / bands) * shape.length;
        const Ring ring = add_ring(mesh, shape.radius, 0.5 * std::numbers::pi, center_y, quarter_rings);
        add_band(mesh, previous, ring, true);
        previous = ring;
    }
    for (std::uint32_t k = quarter_rings; k-- > 0;) {
        const Ring ring =
            add_ring(mesh, shape.radius, std::numbers::pi - k * ring_angle, -0.5 * shape.length, k);
        add_band(mesh, ring, previous, false);
        previous = ring;
    }
    return mesh;
}

}  // namespace gelatin
