#include "mesh/mesh_in_memory.h"

#include <fmt/core.h>

#include <cmath>

#include "core/counted.h"
#include "gelatin/error.h"
#include "mesh/surface_repair.h"
#include "mesh/tet_repair.h"

namespace gelatin {
namespace {

std::optional<MeshProblem> find_far_vertex(const std::vector<glm::dvec3>& vertices) {
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        const glm::dvec3& p = vertices[v];
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
        return MeshProblem{"vertices", v, fmt::format("[{}, {}, {}]", p.x, p.y, p.z), "must be finite"};
    }
    return {};
}

template <class Corners>
std::optional<MeshProblem> find_bad_index(const char* array, const std::vector<Corners>& elements,
                                          std::size_t vertices) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
        for (int k = 0; k < Corners::length(); ++k) {
            if (elements[e][k] < vertices) continue;
            return MeshProblem{
                array, e, fmt::format("{}", elements[e][k]),
                fmt::format("must name one of {}, from 0", counted(vertices, "vertex", "vertices"))};
        }
    }
    return {};
}

}  // namespace

std::optional<MeshProblem> find_problem(const Mesh& mesh) {
    const bool has_triangles = !mesh.triangles.empty(), has_tets = !mesh.tets.empty();
    if (!has_triangles && !has_tets) return MeshProblem{"", {}, {}, "has neither triangles nor tets"};
    if (has_triangles && has_tets) return MeshProblem{"", {}, {}, "must have triangles or tets, not both"};
    if (!mesh.attributes.empty() && mesh.attributes.size() != mesh.tets.size()) {
        return MeshProblem{"attributes",
                           {},
                           {},
                           fmt::format("are {} for {}; allowed are none, or one for each tet",
                                       mesh.attributes.size(), counted(mesh.tets.size(), "tet"))};
    }
    if (auto problem = find_far_vertex(mesh.vertices)) return problem;
    if (auto problem = find_bad_index("triangles", mesh.triangles, mesh.vertices.size())) return problem;
    return find_bad_index("tets", mesh.tets, mesh.vertices.size());
}

SurfaceMesh surface_in_memory(const Mesh& mesh, const std::string& name, Notes& notes) {
    SurfaceMesh surface{mesh.vertices, mesh.triangles};
    repair_surface(surface, notes);
    if (surface.faces.empty()) throw InvalidInput({name, 0, {}, {}, "has no faces with an area"});
    return surface;
}

TetMesh tets_in_memory(const Mesh& mesh, const std::string& name, Notes& notes) {
    TetMesh tets{mesh.vertices, mesh.tets, {}, mesh.attributes};
    repair_tets(tets, name, notes);
    return tets;
}

}  // namespace gelatin
