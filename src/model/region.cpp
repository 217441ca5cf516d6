#include "model/region.h"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

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

bool contains(const Region& region, const glm::dvec3& point) {
    return std::visit(IsInside{point}, region);
}

}  // namespace gelatin
