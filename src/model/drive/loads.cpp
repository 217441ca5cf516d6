#include "model/drive/loads.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "model/region.h"

namespace gelatin {
namespace {

using Entries = std::vector<std::pair<std::uint32_t, NodeLoad>>;  // by the model's node index

// The effect of one load on the nodes of one object.
struct LoadPacker {
    const Region& region;
    const TetMesh& mesh;
    std::span<const float> masses;
    std::uint32_t first_node, load;
    Entries& entries;

    void operator()(const ForceLoad& force) const {
        const std::vector<std::uint32_t> nodes = find_inside(region, mesh.positions);
        double mass = 0.0;
        for (const std::uint32_t n : nodes) mass += static_cast<double>(masses[n]);
        for (const std::uint32_t n : nodes) add_dead(n, static_cast<double>(masses[n]) / mass * force.sum);
    }

    void operator()(const TractionLoad& traction) const {
        std::map<std::uint32_t, double> areas;  // for each of its nodes a third of the face's [m^2]
        for (const glm::uvec3& face : find_faces_inside(region, mesh)) {
            const glm::dvec3 a = mesh.positions[face.x];
            const double twice =
                glm::length(glm::cross(mesh.positions[face.y] - a, mesh.positions[face.z] - a));
            for (int k = 0; k < 3; ++k) areas[face[k]] += twice / 6.0;
        }
        for (const auto& [n, area] : areas) add_dead(n, area * traction.stress);
    }

    void operator()(const PressureLoad& pressure) const {
        const glm::vec4 sixth(0.0f, 0.0f, 0.0f, static_cast<float>(pressure.pressure / 6.0));
        for (const glm::uvec3& face : find_faces_inside(region, mesh)) {
            const glm::uvec3 f = face + first_node;
            for (int k = 0; k < 3; ++k)
                entries.push_back({f[k], {sixth, load, f[(k + 1) % 3], f[(k + 2) % 3], 0}});
        }
    }

    void add_dead(std::uint32_t n, const glm::dvec3& force) const {
        const std::uint32_t node = first_node + n;
        entries.push_back({node, {glm::vec4(glm::vec3(force), 0.0f), load, node, node, 0}});
    }
};

}  // namespace

std::vector<glm::uvec3> find_faces_inside(const Region& region, const TetMesh& mesh) {
    std::vector<glm::uvec3> inside;
    const auto is_inside = [&](std::uint32_t n) { return holds(region, mesh.positions[n]); };
    for (const glm::uvec3& face : mesh.faces) {
        if (is_inside(face.x) && is_inside(face.y) && is_inside(face.z)) inside.push_back(face);
    }
    return inside;
}

void append_loads(const std::vector<LoadDescription>& descriptions, const TetMesh& mesh,
                  std::span<const float> masses, std::uint32_t first_node, Loads& loads) {
    Entries entries;
    for (const LoadDescription& description : descriptions) {
        const auto load = static_cast<std::uint32_t>(loads.spans.size());
        std::visit(LoadPacker{description.region, mesh, masses, first_node, load, entries}, description.kind);
        Loads::Span span;
        if (description.from) span.from = *description.from;
        if (description.until) span.until = *description.until;
        loads.spans.push_back(span);
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const std::size_t before = loads.nodes.size();
    for (const auto& [node, entry] : entries) {
        const auto place = static_cast<std::uint32_t>(loads.entries.size());
        if (loads.nodes.size() == before || loads.nodes.back().node != node)
            loads.nodes.push_back({node, place, place, 0});
        loads.entries.push_back(entry);
        loads.nodes.back().end = place + 1;
    }
}

std::vector<float> load_factors(const Loads& loads, double time, double step) {
    std::vector<float> factors;
    for (const Loads::Span& span : loads.spans) {
        const double overlap = std::min(span.until, time + step) - std::max(span.from, time);
        factors.push_back(static_cast<float>(std::clamp(overlap / step, 0.0, 1.0)));
    }
    return factors;
}

}  // namespace gelatin
