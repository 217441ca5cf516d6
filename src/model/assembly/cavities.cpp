#include "model/assembly/cavities.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

#include "gelatin/error.h"
#include "mesh/closed_pieces.h"
#include "model/region.h"
#include "model/setting_names.h"

namespace gelatin {
namespace {

using Faces = std::vector<glm::uvec3>;

bool holds_all(const Region& region, const Faces& hollow, const TetMesh& mesh) {
    return std::all_of(hollow.begin(), hollow.end(), [&](const glm::uvec3& face) {
        return holds(region, mesh.positions[face.x]) && holds(region, mesh.positions[face.y]) &&
               holds(region, mesh.positions[face.z]);
    });
}

// What is wrong with so many hollows of a region, or of the whole object.
std::string problem_of(std::size_t found, std::size_t hollows, bool has_region) {
    if (hollows == 0) return "needs a hollow that the object's tets enclose: it has none";
    if (!has_region) return fmt::format("needs a region that selects a hollow: the object has {}", hollows);
    return fmt::format(
        "must hold one hollow whole: it holds {} of the object's {} (regions are in world "
        "coordinates at the start)",
        found, hollows);
}

}  // namespace

std::string name_of_cavity(const CavityDescription& description, std::size_t index) {
    return description.name.empty() ? fmt::format("cavity {}", index + 1) : description.name;
}

std::vector<Cavity> make_cavities(const std::filesystem::path& file, const ObjectDescription& object,
                                  const TetMesh& mesh) {
    std::vector<Cavity> cavities;
    if (object.cavities.empty()) return cavities;
    const std::vector<Faces> hollows = find_hollows(mesh);
    std::map<std::size_t, std::string> taken;  // hollows, and by whom
    for (std::size_t c = 0; c < object.cavities.size(); ++c) {
        const CavityDescription& description = object.cavities[c];
        const std::string name = name_of_cavity(description, c);
        const auto fail = [&](const std::string& problem) {
            throw InvalidInput({file.string(),
                                description.line,
                                fmt::format("{}.{}.cavity[{}]{}", table_name(object), object.name, c,
                                            description.region ? ".region" : ""),
                                {},
                                problem});
        };
        std::vector<std::size_t> found;
        for (std::size_t h = 0; h < hollows.size(); ++h)
            if (!description.region || holds_all(*description.region, hollows[h], mesh)) found.push_back(h);
        if (found.size() != 1) fail(problem_of(found.size(), hollows.size(), description.region.has_value()));
        const auto [of, is_new] = taken.emplace(found.front(), name);
        if (!is_new) fail(fmt::format("must not select the hollow of '{}', too", of->second));
        const Faces& faces = hollows[found.front()];
        Cavity& cavity = cavities.emplace_back();
        cavity.gas = description;
        cavity.gas.name = name;
        cavity.faces = faces;
        cavity.rest_volume = enclosed_volume<glm::dvec3>(faces, mesh.positions);
    }
    return cavities;
}

}  // namespace gelatin
