#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <utility>

#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"
#include "mesh/surface_mesh.h"

namespace gelatin {

/// Surfaces with the faults of files from everywhere, at random.
class BrokenSurfaces {
public:
    explicit BrokenSurfaces(unsigned seed) : random_(seed) {}

    SurfaceMesh make() {
        SurfaceMesh surface = start();
        const int faults = below(4);
        for (int k = 0; k < faults; ++k) {
            switch (below(12)) {
                case 0:
                    remove_faces(surface);
                    break;
                case 1:
                    flip_faces(surface);
                    break;
                case 2:
                    repeat_faces(surface);
                    break;
                case 3:
                    append(surface, scaled(surface, 0.3 + 0.6 * fraction()));
                    break;  // nested
                case 4:
                    append(surface, moved(surface, 0.4 * direction()));
                    break;  // crossing
                case 5:
                    scatter(surface);
                    break;
                case 6:
                    stretch(surface);
                    break;
                case 7:
                    separate_faces(surface);
                    break;
                case 8:
                    flatten_faces(surface);
                    break;
                case 9:
                    repeat_corners(surface);
                    break;
                case 10:
                    surface = scaled(surface, std::pow(10.0, 20.0 * fraction() - 10.0));
                    break;
                default:
                    spoil_a_number(surface);
                    break;
            }
        }
        return surface;
    }

private:
    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
    double fraction() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
    glm::dvec3 direction() {
        return {2.0 * fraction() - 1.0, 2.0 * fraction() - 1.0, 2.0 * fraction() - 1.0};
    }

    SurfaceMesh start() {
        if (below(100) == 0) return crumbs(1000 + below(4000), 0.05);
        switch (below(6)) {
            case 0:
                return make_sphere({0.5, 1 + below(6)});
            case 1:
                return make_box({{0.1 + fraction(), 0.02 + 0.5 * fraction(), 0.1 + fraction()}, {3, 1, 4}});
            case 2:
                return make_capsule({0.05 + 0.2 * fraction(), 1.0, 4});
            case 3:
                return crumbs(1 + below(60), 0.2);
            case 4:
                return loose_faces();
            default:
                return sheet();
        }
    }

    // Many small closed surfaces.
    SurfaceMesh crumbs(int count, double largest) {
        SurfaceMesh surface;
        for (int k = 0; k < count; ++k)
            append(surface, cube(direction(), 0.01 + largest * fraction() * fraction()));
        return surface;
    }
    SurfaceMesh loose_faces() {
        SurfaceMesh surface;
        const std::uint32_t count = 1u + static_cast<std::uint32_t>(below(200));
        for (std::uint32_t f = 0; f < count; ++f) {
            for (int k = 0; k < 3; ++k) surface.positions.push_back(direction());
            surface.faces.emplace_back(3 * f, 3 * f + 1, 3 * f + 2);
        }
        return surface;
    }
    SurfaceMesh sheet() {
        SurfaceMesh surface = make_box({{1.0, 1.0, 1.0}, {5, 5, 5}});
        const double thickness = below(2) == 0 ? 0.0 : 0.1 * fraction();
        for (glm::dvec3& p : surface.positions) p.y *= thickness;
        return surface;
    }

    void remove_faces(SurfaceMesh& surface) {
        const double share = 0.5 * fraction();
        std::erase_if(surface.faces, [&](const glm::uvec3&) { return fraction() < share; });
    }
    void flip_faces(SurfaceMesh& surface) {
        const double share = 0.5 * fraction();
        for (glm::uvec3& face : surface.faces) {
            if (fraction() < share) std::swap(face[1], face[2]);
        }
    }
    void repeat_faces(SurfaceMesh& surface) {
        const std::size_t count = surface.faces.size() / 3;
        for (std::size_t f = 0; f < count; ++f) surface.faces.push_back(surface.faces[f]);
    }
    static SurfaceMesh scaled(SurfaceMesh surface, double factor) {
        for (glm::dvec3& p : surface.positions) p *= factor;
        return surface;
    }
    static SurfaceMesh moved(SurfaceMesh surface, const glm::dvec3& displacement) {
        for (glm::dvec3& p : surface.positions) p += displacement;
        return surface;
    }
    void scatter(SurfaceMesh& surface) {
        const double size = 0.1 * fraction();
        for (glm::dvec3& p : surface.positions) p += size * direction();
    }
    void stretch(SurfaceMesh& surface) {  // faces become slivers
        for (glm::dvec3& p : surface.positions) p.x *= 20.0;
    }
    // A corner comes to lie on the opposite edge, or almost.
    void flatten_faces(SurfaceMesh& surface) {
        const double share = 0.3 * fraction(), height = std::pow(10.0, -16.0 * fraction());
        for (const glm::uvec3& f : surface.faces) {
            if (fraction() > share) continue;
            const glm::dvec3 foot = 0.5 * (surface.positions[f[0]] + surface.positions[f[1]]);
            surface.positions[f[2]] = foot + height * (surface.positions[f[2]] - foot);
        }
    }
    void repeat_corners(SurfaceMesh& surface) {
        const double share = 0.2 * fraction();
        for (glm::uvec3& face : surface.faces) {
            if (fraction() < share) face[2] = face[1];
        }
    }
    void spoil_a_number(SurfaceMesh& surface) {
        constexpr double kNumbers[] = {std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::infinity(),
                                       1e300,
                                       1e35,
                                       1e12,
                                       1e-300,
                                       std::numeric_limits<double>::denorm_min()};
        const auto vertex = static_cast<std::size_t>(below(static_cast<int>(surface.positions.size())));
        surface.positions[vertex][below(3)] = kNumbers[below(7)];
    }
    void separate_faces(SurfaceMesh& surface) {
        SurfaceMesh apart;
        for (const glm::uvec3& face : surface.faces) {
            const auto first = static_cast<std::uint32_t>(apart.positions.size());
            for (int k = 0; k < 3; ++k)
                apart.positions.push_back(surface.positions[face[k]] + 0.01 * direction());
            apart.faces.emplace_back(first, first + 1, first + 2);
        }
        surface = apart;
    }

    std::mt19937 random_;
};

}  // namespace gelatin
