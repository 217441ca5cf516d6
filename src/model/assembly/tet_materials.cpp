#include "model/assembly/tet_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "gelatin/error.h"
#include "model/region.h"

namespace gelatin {
namespace {

glm::dvec3 centroid(const TetMesh& mesh, const glm::uvec4& tet) {
    return 0.25 * (mesh.positions[tet[0]] + mesh.positions[tet[1]] + mesh.positions[tet[2]] +
                   mesh.positions[tet[3]]);
}

struct Holds {
    const TetMesh& mesh;
    std::size_t tet;
    bool operator()(const Region& region) const { return holds(region, centroid(mesh, mesh.tets[tet])); }
    bool operator()(const TetAttribute& attribute) const {
        return !mesh.attributes.empty() && mesh.attributes[tet] == attribute.number;
    }
};

[[noreturn]] void refuse_empty(const ObjectDescription& object, std::size_t part, const TetMesh& mesh,
                               const std::string& file) {
    const PartDescription& description = object.parts[part];
    InputProblem problem{
        file, description.line, fmt::format("object.{}.part[{}]", object.name, part), {}, {}};
    if (const auto* attribute = std::get_if<TetAttribute>(&description.where)) {
        const std::set<int> known(mesh.attributes.begin(), mesh.attributes.end());
        problem.field += ".attribute";
        problem.value = std::to_string(attribute->number);
        problem.problem = known.empty() ? "no tet has it: the object's mesh gives its tets no attributes"
                                        : fmt::format("no tet has it; there are {}", fmt::join(known, ", "));
    } else {
        problem.field += ".region";
        problem.problem = "holds the centroid of no tet of the object (regions are in world coordinates)";
    }
    throw InvalidInput(problem);
}

}  // namespace

std::vector<std::uint32_t> choose_tet_materials(const ObjectDescription& object, const TetMesh& mesh,
                                                const std::string& file) {
    if (object.parts.empty()) return {};
    std::vector<std::uint32_t> materials(mesh.tets.size(), 0);
    for (std::size_t p = 0; p < object.parts.size(); ++p) {
        bool is_empty = true;
        for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
            if (!std::visit(Holds{mesh, t}, object.parts[p].where)) continue;
            materials[t] = static_cast<std::uint32_t>(p + 1);
            is_empty = false;
        }
        if (is_empty) refuse_empty(object, p, mesh, file);
    }
    return materials;
}

}  // namespace gelatin
