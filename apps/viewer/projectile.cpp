#include "projectile.h"

#include <fmt/core.h>

#include <algorithm>

namespace gelatin::viewer {
namespace {

constexpr double kStart = 0.25;  // fraction of the distance to the target
constexpr double kFlight = 0.6;  // [s]

// Centre of the nodes at the start: shapes need not be centred on their origin.
glm::dvec3 start_center(const Model& model, std::size_t object) {
    const Range& nodes = model.objects[object].nodes;
    glm::dvec3 sum(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) sum += glm::dvec3(model.positions[n]);
    return sum / static_cast<double>(nodes.count);
}

std::string free_name(const Scene& scene, const std::string& name) {
    const auto is_taken = [&](const std::string& candidate) {
        return std::any_of(scene.objects.begin(), scene.objects.end(),
                           [&](const ObjectDescription& o) { return o.name == candidate; });
    };
    for (int i = 2;; ++i) {
        std::string candidate = fmt::format("{} {}", name, i);
        if (!is_taken(candidate)) return candidate;
    }
}

}  // namespace

ObjectDescription make_projectile(const Scene& scene, const Model& model, std::size_t object, const Ray& ray,
                                  double distance) {
    const ObjectDescription& original = scene.objects[object];
    ObjectDescription copy = original;
    copy.name = free_name(scene, original.name);
    const glm::dvec3 direction(ray.direction);
    const glm::dvec3 start = glm::dvec3(ray.origin) + kStart * distance * direction;
    copy.position += start - start_center(model, object);
    copy.velocity = (1.0 - kStart) * distance / kFlight * direction;
    copy.pins.clear();
    copy.handles.clear();
    copy.loads.clear();
    copy.start = {};
    std::erase_if(copy.parts,
                  [](const PartDescription& part) { return std::holds_alternative<Region>(part.where); });
    return copy;
}

}  // namespace gelatin::viewer
