#include "model/drive/handle_animation.h"

namespace gelatin {

double HandleAnimation::end() const {
    return motion ? motion->end() : 0.0;
}

std::vector<glm::dvec3> HandleAnimation::arms(const std::vector<glm::dvec3>& vertices) const {
    std::vector<glm::dvec3> arms;
    arms.reserve(sources.size());
    for (const std::uint32_t source : sources) arms.push_back(map * vertices[source] + offset);
    return arms;
}

}  // namespace gelatin
