#include "model/model.h"

#include <algorithm>

namespace gelatin {

bool Model::has_damping() const {
    return std::any_of(velocities.begin(), velocities.end(), [](const glm::vec4& v) { return v.w > 0.0f; });
}

}  // namespace gelatin
