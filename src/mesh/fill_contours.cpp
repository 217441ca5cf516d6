#include "mesh/fill_contours.h"

#include <GL/glu.h>
#include <fmt/core.h>

#include <algorithm>
#include <deque>
#include <glm/geometric.hpp>
#include <memory>

#include "gelatin/error.h"
#include "mesh/topology.h"

namespace gelatin {

namespace {

/// What the tessellator's callbacks write to. The tessellator keeps addresses of vertices, which stay valid
/// in a growing deque.
struct Tessellation {
    struct Vertex {
        double position[3];
        std::uint32_t index;
    };
    std::deque<Vertex> vertices;
    std::vector<std::uint32_t> corners;
    GLenum error = 0;

    Vertex* add(double x, double y) {
        vertices.push_back({{x, y, 0.0}, static_cast<std::uint32_t>(vertices.size())});
        return &vertices.back();
    }
};

// GLU draws nothing here: its tessellator is pure arithmetic and needs no context.
void GLAPIENTRY on_vertex(void* vertex, void* data) {
    static_cast<Tessellation*>(data)->corners.push_back(static_cast<Tessellation::Vertex*>(vertex)->index);
}
void GLAPIENTRY on_crossing(GLdouble at[3], void**, GLfloat*, void** vertex, void* data) {
    *vertex = static_cast<Tessellation*>(data)->add(at[0], at[1]);
}
void GLAPIENTRY on_edge_flag(GLboolean) {}  // its presence alone requests separate triangles
void GLAPIENTRY on_error(GLenum error, void* data) {
    static_cast<Tessellation*>(data)->error = error;
}

template <class Callback>
void set_callback(GLUtesselator* tessellator, GLenum which, Callback callback) {
    gluTessCallback(tessellator, which, reinterpret_cast<_GLUfuncptr>(callback));
}

/// The triangles, and the vertices that they use: coincident or interior points may not be used by any.
FlatMesh compact(const Tessellation& tessellation) {
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> number(tessellation.vertices.size(), kUnused);
    FlatMesh mesh;
    const auto renumber = [&](std::uint32_t corner) {
        if (number[corner] == kUnused) {
            number[corner] = static_cast<std::uint32_t>(mesh.positions.size());
            const double* position = tessellation.vertices[corner].position;
            mesh.positions.emplace_back(position[0], position[1]);
        }
        return number[corner];
    };
    const std::vector<std::uint32_t>& corners = tessellation.corners;
    for (std::size_t k = 0; k + 2 < corners.size(); k += 3) {
        const std::uint32_t a = renumber(corners[k]), b = renumber(corners[k + 1]),
                            c = renumber(corners[k + 2]);
        mesh.triangles.emplace_back(a, b, c);
    }
    return mesh;
}

FlatMesh tessellate(const std::vector<Contour>& contours) {
    const std::unique_ptr<GLUtesselator, decltype(&gluDeleteTess)> tessellator(gluNewTess(), gluDeleteTess);
    set_callback(tessellator.get(), GLU_TESS_VERTEX_DATA, on_vertex);
    set_callback(tessellator.get(), GLU_TESS_COMBINE_DATA, on_crossing);
    set_callback(tessellator.get(), GLU_TESS_EDGE_FLAG, on_edge_flag);
    set_callback(tessellator.get(), GLU_TESS_ERROR_DATA, on_error);
    gluTessProperty(tessellator.get(), GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_NONZERO);
    gluTessNormal(tessellator.get(), 0.0, 0.0, 1.0);

    Tessellation result;
    gluTessBeginPolygon(tessellator.get(), &result);
    for (const Contour& contour : contours) {
        gluTessBeginContour(tessellator.get());
        for (const glm::dvec2& point : contour) {
            Tessellation::Vertex* vertex = result.add(point.x, point.y);
            gluTessVertex(tessellator.get(), vertex->position, vertex);
        }
        gluTessEndContour(tessellator.get());
    }
    gluTessEndPolygon(tessellator.get());
    if (result.error != 0) {
        throw InvalidInput(fmt::format("the outlines of the text cannot be filled: {}",
                                       reinterpret_cast<const char*>(gluErrorString(result.error))));
    }

    return compact(result);
}

}  // namespace

double triangle_quality(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 ab = b - a, ac = c - a, bc = c - b;
    const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    return longest > 0.0 ? (ab.x * ac.y - ab.y * ac.x) / longest : 0.0;
}

void improve_triangles(FlatMesh& mesh) {
    constexpr double kGain = 1e-9;  // less is rounding
    const auto& at = mesh.positions;
    bool changed = true;
    for (std::size_t sweep = 0; changed && sweep < mesh.triangles.size() + 1; ++sweep) {
        changed = false;
        std::vector<bool> is_new(mesh.triangles.size(),
                                 false);  // the triangles stored in `edge` are no longer valid
        for (const SurfaceEdge& edge : surface_edges(mesh.triangles)) {
            const auto [first, second] = edge.faces;
            if (is_new[first] || is_new[second]) continue;
            const auto [c, d] = edge.corners;
            auto [a, b] = std::pair(edge.nodes[0], edge.nodes[1]);
            const glm::uvec3& t = mesh.triangles[first];
            const bool goes_forward =
                (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
            if (!goes_forward) std::swap(a, b);
            const double before =
                std::min(triangle_quality(at[a], at[b], at[c]), triangle_quality(at[b], at[a], at[d]));
            const double after =
                std::min(triangle_quality(at[a], at[d], at[c]), triangle_quality(at[d], at[b], at[c]));
            if (after < before + kGain) continue;
            mesh.triangles[first] = {a, d, c};
            mesh.triangles[second] = {d, b, c};
            is_new[first] = is_new[second] = changed = true;
        }
    }
}

FlatMesh fill_contours(const std::vector<Contour>& contours) {
    FlatMesh mesh = tessellate(contours);
    improve_triangles(mesh);
    return mesh;
}

}  // namespace gelatin
