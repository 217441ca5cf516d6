#include "sim/thin_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

namespace gelatin {
namespace {

glm::dvec3 place_of(const Model& model, std::uint32_t node) {
    return glm::dvec3(glm::vec3(model.positions[node]));
}

double surface_area(const Model& model) {
    double twice = 0.0;
    for (const Face& face : model.faces) {
        const glm::dvec3 a = place_of(model, face.a);
        twice += glm::length(glm::cross(place_of(model, face.b) - a, place_of(model, face.c) - a));
    }
    return 0.5 * twice;
}

// Points of one body with a minimum distance, in a grid of cells of that width.
class SpacedPoints {
public:
    explicit SpacedPoints(double spacing) : spacing_(spacing) {}

    /// @return false if another one is too near
    bool add(const glm::dvec3& point) {
        const glm::dvec3 cell = glm::floor(point / spacing_);
        for (int i = 0; i < 27; ++i) {
            const glm::dvec3 beside = cell + glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            const auto [first, last] = cells_.equal_range(key(beside));
            const auto is_near = [&](const auto& entry) {
                return glm::distance(entry.second, point) < spacing_;
            };
            if (std::any_of(first, last, is_near)) return false;
        }
        cells_.emplace(key(cell), point);
        return true;
    }

private:
    static std::tuple<double, double, double> key(const glm::dvec3& cell) { return {cell.x, cell.y, cell.z}; }

    double spacing_;
    std::multimap<std::tuple<double, double, double>, glm::dvec3> cells_;
};

}  // namespace

// If points are placed at random as long as there is room, each occupies 0.7 of a square of the spacing
// (Rényi's parking problem, in the plane).
std::vector<std::uint32_t> thin_surface_nodes(const Model& model, std::size_t count) {
    const double spacing = std::sqrt(1.4 * surface_area(model) / static_cast<double>(count));
    std::vector<std::uint32_t> nodes = model.surface_parts.nodes;
    std::sort(nodes.begin(), nodes.end());  // by object
    std::vector<std::uint32_t> kept;
    auto node = nodes.begin();
    for (const ModelObject& object : model.bodies()) {
        SpacedPoints points(spacing);
        for (; node != nodes.end() && *node < object.nodes.end(); ++node) {
            if (points.add(place_of(model, *node))) kept.push_back(*node);
        }
    }
    return kept;
}

}  // namespace gelatin
