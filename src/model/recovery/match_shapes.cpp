#include "model/recovery/match_shapes.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "model/model.h"

namespace gelatin {
namespace {

RestMoment make_rest_moment(const Model& model, const ModelObject& object, std::vector<glm::vec4>& offsets) {
    glm::dvec3 center(0.0);
    double mass = 0.0;
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        const auto m = static_cast<double>(model.masses[n]);
        center += m * glm::dvec3(model.positions[n]);
        mass += m;
    }
    center /= mass;
    glm::dmat3 moment(0.0);
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        const glm::dvec3 offset = glm::dvec3(model.positions[n]) - center;
        moment += static_cast<double>(model.masses[n]) * glm::outerProduct(offset, offset);
        offsets.emplace_back(glm::vec3(offset), model.masses[n]);
    }
    const glm::mat3 inverse(glm::inverse(moment));
    const auto most_inverted = static_cast<float>(kMostInverted * object.tets.count);
    return {glm::vec4(inverse[0], static_cast<float>(mass)), glm::vec4(inverse[1], most_inverted),
            glm::vec4(inverse[2], 0.0f)};
}

}  // namespace

MatchShapes make_match_shapes(const Model& model) {
    MatchShapes shapes;
    shapes.offsets.reserve(model.positions.size());
    for (const ModelObject& object : model.bodies())
        shapes.objects.push_back(make_rest_moment(model, object, shapes.offsets));
    return shapes;
}

}  // namespace gelatin
