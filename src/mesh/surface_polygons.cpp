#include "mesh/surface_polygons.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <span>

#include "mesh/fill_polygon.h"

namespace gelatin {
namespace {

// Approximate sine of the smallest angle; negative if it is wound against `normal`, whose length is 1.
double quality(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& normal) {
    const glm::dvec3 ab = b - a, ac = c - a, bc = c - b;
    const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
    return longest > 0.0 ? dot(cross(ab, ac), normal) / longest : 0.0;
}

class Triangulation {
public:
    explicit Triangulation(SurfacePolygons polygons) : from_(std::move(polygons)) {
        mesh_.positions = std::move(from_.positions);
        mesh_.look.materials = std::move(from_.materials);
        mesh_.faces.reserve(from_.corners.size() - std::min(from_.corners.size(), 2 * from_.sizes.size()));
    }

    SurfaceMesh make(Notes& notes) {
        std::size_t first = 0, too_small = 0;
        for (polygon_ = 0; polygon_ < from_.sizes.size(); ++polygon_) {
            list_corners(first, from_.sizes[polygon_]);
            first += from_.sizes[polygon_];
            if (corners_.size() < 3) {
                ++too_small;
            } else if (corners_.size() == 3) {
                add({0, 1, 2});
            } else if (corners_.size() == 4) {
                add_quad();
            } else {
                add_polygon();
            }
        }
        if (too_small > 0)
            notes.push_back(
                fmt::format("ignored faces of fewer than three different corners: {}", too_small));
        if (crossing_ > 0)
            notes.push_back(fmt::format("polygons whose outlines cross themselves: {}", crossing_));
        return std::move(mesh_);
    }

private:
    // Each corner once, where a polygon repeats it. Triangles that do are left to repair_surface.
    void list_corners(std::size_t first, std::size_t size) {
        corners_.clear();
        if (size == 3) return corners_.assign({first, first + 1, first + 2});
        for (std::size_t k = first; k < first + size; ++k) {
            if (corners_.empty() || from_.corners[corners_.back()] != from_.corners[k]) corners_.push_back(k);
        }
        while (corners_.size() > 1 && from_.corners[corners_.front()] == from_.corners[corners_.back()])
            corners_.pop_back();
    }

    const glm::dvec3& position(std::size_t k) const { return mesh_.positions[from_.corners[corners_[k]]]; }

    void add(const glm::uvec3& triangle) {
        const std::array of = {corners_[triangle.x], corners_[triangle.y], corners_[triangle.z]};
        mesh_.faces.emplace_back(from_.corners[of[0]], from_.corners[of[1]], from_.corners[of[2]]);
        const auto& uvs = from_.corner_uvs;
        if (!uvs.empty()) mesh_.look.corner_uvs.push_back({uvs[of[0]], uvs[of[1]], uvs[of[2]]});
        if (!from_.polygon_materials.empty())
            mesh_.look.face_materials.push_back(from_.polygon_materials[polygon_]);
    }

    // From its first corner, as most programs do, unless one of the two triangles is flat or outside.
    void add_quad() {
        const glm::dvec3 &a = position(0), &b = position(1), &c = position(2), &d = position(3);
        const glm::dvec3 area = cross(c - a, d - b);
        const glm::dvec3 normal = area / std::max(length(area), 1e-300);
        constexpr double kFlat = 1e-6;
        const double usual = std::min(quality(a, b, c, normal), quality(a, c, d, normal));
        const bool is_usual =
            usual > kFlat || usual >= std::min(quality(a, b, d, normal), quality(b, c, d, normal));
        add(is_usual ? glm::uvec3(0, 1, 2) : glm::uvec3(0, 1, 3));
        add(is_usual ? glm::uvec3(0, 2, 3) : glm::uvec3(1, 2, 3));
    }

    void add_polygon() {
        outline_.clear();
        for (std::size_t k = 0; k < corners_.size(); ++k) outline_.push_back(position(k));
        const FilledPolygon filled = fill_polygon(outline_);
        for (const glm::uvec3& triangle : filled.triangles) add(triangle);
        if (filled.crosses_itself) ++crossing_;
    }

    SurfacePolygons from_;
    SurfaceMesh mesh_;
    std::size_t polygon_ = 0;
    std::vector<std::size_t> corners_;  // of this polygon: indices into from_.corners
    std::vector<glm::dvec3> outline_;
    std::size_t crossing_ = 0;
};

}  // namespace

SurfaceMesh triangulate(SurfacePolygons polygons, Notes& notes) {
    return Triangulation(std::move(polygons)).make(notes);
}

}  // namespace gelatin
