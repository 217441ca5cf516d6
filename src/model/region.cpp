#include "model/region.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace gelatin {
namespace {

struct IsInside {
    glm::dvec3 point;
    bool operator()(const BoxRegion& box) const {
        return glm::all(glm::greaterThanEqual(point, box.min)) &&
               glm::all(glm::lessThanEqual(point, box.max));
    }
    bool operator()(const SphereRegion& sphere) const {
        return glm::distance(point, sphere.center) <= sphere.radius;
    }
    bool operator()(const HalfSpaceRegion& half) const { return glm::dot(half.normal, point) <= half.offset; }
};

}  // namespace

bool holds(const Region& region, const glm::dvec3& point) {
    return std::visit(IsInside{point}, region);
}

bool any_holds(const std::vector<Region>& regions, const glm::dvec3& point) {
    return std::any_of(regions.begin(), regions.end(), [&](const Region& r) { return holds(r, point); });
}

std::vector<std::uint32_t> find_inside(const Region& region, const std::vector<glm::dvec3>& points) {
    std::vector<std::uint32_t> inside;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (holds(region, points[p])) inside.push_back(p);
    }
    return inside;
}

}  // namespace gelatin
