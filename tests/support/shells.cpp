#include "support/shells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "mesh/shapes.h"

namespace gelatin::test {
namespace {

void add_tet(Mesh& mesh, glm::uvec4 tet) {
    const auto at = [&](int k) { return mesh.vertices[tet[k]]; };
    if (glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0)) < 0.0) std::swap(tet.z, tet.w);
    mesh.tets.push_back(tet);
}

}  // namespace

// The diagonal of a side goes up from the vertex with the lower number, so that neighbours agree.
std::shared_ptr<const Mesh> make_shell(const std::vector<std::vector<glm::dvec3>>& layers,
                                       const std::vector<glm::uvec3>& faces) {
    Mesh mesh;
    for (const auto& layer : layers) mesh.vertices.insert(mesh.vertices.end(), layer.begin(), layer.end());
    const auto count = static_cast<std::uint32_t>(layers[0].size());
    for (std::uint32_t l = 0; l + 1 < layers.size(); ++l)
        for (const glm::uvec3& face : faces) {
            std::array<std::uint32_t, 3> low{face.x, face.y, face.z};
            std::sort(low.begin(), low.end());
            std::array<std::uint32_t, 3> high{};
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] += l * count;
                high[k] = low[k] + count;
            }
            add_tet(mesh, {low[0], low[1], low[2], high[2]});
            add_tet(mesh, {low[0], low[1], high[1], high[2]});
            add_tet(mesh, {low[0], high[0], high[1], high[2]});
        }
    return std::make_shared<const Mesh>(std::move(mesh));
}

std::shared_ptr<const Mesh> sphere_shell(double inner, double outer, int frequency, int layers) {
    const SurfaceMesh unit = make_sphere({1.0, frequency});
    std::vector<std::vector<glm::dvec3>> all;
    for (int l = 0; l <= layers; ++l) {
        const double radius = std::lerp(inner, outer, static_cast<double>(l) / layers);
        std::vector<glm::dvec3>& layer = all.emplace_back(unit.positions);
        for (glm::dvec3& p : layer) p *= radius;
    }
    return make_shell(all, unit.faces);
}

std::shared_ptr<const Mesh> box_shell(const glm::dvec3& size, double wall, const glm::ivec3& segments,
                                      int layers) {
    const SurfaceMesh inner = make_box({size, segments});
    std::vector<std::vector<glm::dvec3>> all;
    for (int l = 0; l <= layers; ++l) {
        const glm::dvec3 scale = 1.0 + 2.0 * wall * l / layers / size;
        std::vector<glm::dvec3>& layer = all.emplace_back(inner.positions);
        for (glm::dvec3& p : layer) p *= scale;
    }
    return make_shell(all, inner.faces);
}

std::shared_ptr<const Mesh> joined(const Mesh& first, const Mesh& second, const glm::dvec3& displacement) {
    Mesh mesh = first;
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const glm::dvec3& vertex : second.vertices) mesh.vertices.push_back(vertex + displacement);
    for (const glm::uvec4& tet : second.tets) mesh.tets.push_back(tet + count);
    return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace gelatin::test
