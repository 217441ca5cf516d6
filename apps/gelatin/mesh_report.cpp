#include "mesh_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "histogram.h"
#include "mesh/surface_repair.h"
#include "mesh/tet_quality.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

struct Spread {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();

    void add(double value) {
        min = std::min(min, value);
        max = std::max(max, value);
    }
    Json json() const { return {{"min", min}, {"max", max}}; }
};

Json extent_json(const std::vector<glm::dvec3>& positions) {
    glm::dvec3 min = positions.at(0), max = min;
    for (const glm::dvec3& p : positions) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    return {{"min", {min.x, min.y, min.z}}, {"max", {max.x, max.y, max.z}}};
}

void append_text(std::string& text, const Json& object, const std::string& indent) {
    for (const auto& [key, value] : object.items()) {
        text += indent + key + ":";
        if (value.is_object() && value.contains("counts") && value.contains("from")) {
            text += "\n" + draw_histogram(value, indent + "  ");
        } else if (value.is_object()) {
            text += "\n";
            append_text(text, value, indent + "  ");
        } else if (value.is_number_float()) {
            text += fmt::format(" {:.6g}\n", value.get<double>());
        } else if (value.is_string()) {
            text += " " + value.get<std::string>() + "\n";
        } else if (value.is_boolean()) {
            text += value.get<bool>() ? " yes\n" : " no\n";
        } else if (value.is_array()) {
            for (const Json& element : value) {
                text += element.is_number_float() ? fmt::format(" {:.6g}", element.get<double>())
                                                  : " " + element.dump();
            }
            text += "\n";
        } else {
            text += " " + value.dump() + "\n";
        }
    }
}

}  // namespace

double radius_edge_ratio(const TetMesh& mesh, const glm::uvec4& tet) {
    const glm::dvec3 origin = mesh.positions[tet[0]];
    const glm::dvec3 a = mesh.positions[tet[1]] - origin, b = mesh.positions[tet[2]] - origin,
                     c = mesh.positions[tet[3]] - origin;
    const glm::dvec3 bc = glm::cross(b, c), ca = glm::cross(c, a), ab = glm::cross(a, b);
    const glm::dvec3 to_center =
        (glm::dot(a, a) * bc + glm::dot(b, b) * ca + glm::dot(c, c) * ab) / (2.0 * glm::dot(a, bc));
    const double shortest = std::min({glm::length(a), glm::length(b), glm::length(c), glm::distance(a, b),
                                      glm::distance(b, c), glm::distance(c, a)});
    return glm::length(to_center) / shortest;
}

Json describe_surface(const SurfaceMesh& mesh) {
    const Openness openness = measure_openness(mesh);
    Json description = {{"kind", "surface"},
                        {"vertices", mesh.positions.size()},
                        {"faces", mesh.faces.size()},
                        {"closed", openness.is_closed()},
                        {"boundary_edges", openness.boundary_edges},
                        {"non_manifold_edges", openness.non_manifold_edges}};
    if (openness.is_closed()) description["volume"] = signed_volume(mesh);
    description["extent"] = extent_json(mesh.positions);
    return description;
}

Json describe_tets(const TetMesh& mesh) {
    Spread volumes, ratios, radii, angles;
    double volume = 0.0, sum_of_least = 0.0;
    for (const glm::uvec4& tet : mesh.tets) {
        volumes.add(tet_volume(mesh, tet));
        ratios.add(radius_edge_ratio(mesh, tet));
        volume += tet_volume(mesh, tet);
        const auto& p = mesh.positions;
        radii.add(radius_ratio(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]));
        const std::array<double, 6> of_tet = dihedral_angles(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]);
        for (const double angle : of_tet) angles.add(glm::degrees(angle));
        sum_of_least += glm::degrees(*std::min_element(of_tet.begin(), of_tet.end()));
    }
    Json dihedral_angle = angles.json();
    dihedral_angle["mean_of_least"] = sum_of_least / static_cast<double>(mesh.tets.size());
    return {{"kind", "tets"},
            {"nodes", mesh.positions.size()},
            {"tets", mesh.tets.size()},
            {"edges", tet_edges(mesh.tets).size()},
            {"faces", mesh.faces.size()},
            {"volume", volume},
            {"extent", extent_json(mesh.positions)},
            {"tet_volume", volumes.json()},
            {"radius_edge_ratio", ratios.json()},
            {"radius_ratio", radii.json()},
            {"dihedral_angle", dihedral_angle}};
}

void add_histograms(const TetMesh& mesh, Json& description) {
    Histogram angles(0.0, 180.0, 18), radii(0.0, 1.0, 10);
    for (const glm::uvec4& tet : mesh.tets) {
        const auto& p = mesh.positions;
        radii.add(radius_ratio(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]));
        for (const double angle : dihedral_angles(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]))
            angles.add(glm::degrees(angle));
    }
    description["radius_ratio"]["histogram"] = radii.json();
    description["dihedral_angle"]["histogram"] = angles.json();
}

std::string to_text(const Json& description) {
    std::string text;
    append_text(text, description, "");
    return text;
}

void print_notes(const Notes& notes) {
    for (const Note& note : notes)
        std::fprintf(stderr, "gelatin: %s: %s\n", note.is_warning ? "warning" : "note", note.text.c_str());
}

}  // namespace gelatin
