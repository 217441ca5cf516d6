#include "render/frame.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace gelatin::render {
namespace {

constexpr float kKeyDistance = 2.0f;  // of the scene's extent

}  // namespace

glm::vec3 to_key_light() {
    return glm::normalize(glm::vec3(-0.55f, 1.0f, 0.42f));
}

float View::extent() const {
    return std::max(glm::length(bounds.size()), 1e-3f);
}

void View::set_uniforms(const gl::Program& program) const {
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    program.set("world_to_clip", camera.projection(aspect) * camera.view());
    program.set("to_key_light", to_key_light());
    program.set("picture_size", glm::vec2(width, height));
    program.set("eye", camera.eye);
    const float key_distance = kKeyDistance * extent();
    program.set("key_distance", key_distance);
    program.set("key_position", bounds.center() + key_distance * to_key_light());
}

}  // namespace gelatin::render
