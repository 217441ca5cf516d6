#include "render/frame.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

namespace gelatin::render {
namespace {

constexpr float kKeyDistance = 2.0f;    // of the scene's extent
constexpr float kUsualHeight = 720.0f;  // of a picture [pixels], at which lines have their own width
constexpr int kLeastLetterSize = 10, kPictureHeightOfAnEm = 48;  // [pixels]

}  // namespace

glm::vec3 to_key_light() {
    return glm::normalize(glm::vec3(-0.55f, 1.0f, 0.42f));
}

float View::extent() const {
    return std::max(glm::length(bounds.size()), 1e-3f);
}

float View::line_scale() const {
    return std::max(1.0f, static_cast<float>(height) / kUsualHeight);
}

int View::letter_size() const {
    return std::max(kLeastLetterSize, height / kPictureHeightOfAnEm);
}

PixelRect View::pixels_of(const Bounds& box) const {
    const PixelRect all{0, 0, width, height};
    const glm::vec2 size(width, height);
    const glm::mat4 world_to_clip = camera.projection(size.x / size.y) * camera.view();
    glm::vec2 low(size), high(0.0f);
    for (const glm::vec3& corner : box.corners()) {
        const glm::vec4 clip = world_to_clip * glm::vec4(corner, 1.0f);
        if (!(clip.w > 0.0f)) return all;
        const glm::vec2 at = (0.5f * glm::vec2(clip) / clip.w + 0.5f) * size;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    if (!glm::all(glm::lessThanEqual(low, high))) return all;
    // One more for rounding.
    const glm::ivec2 first = glm::ivec2(glm::clamp(low, glm::vec2(0.0f), size)) - 1;
    const glm::ivec2 end = glm::ivec2(glm::clamp(high, glm::vec2(0.0f), size)) + 2;
    return {std::max(first.x, 0), std::max(first.y, 0), std::min(end.x, width), std::min(end.y, height)};
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
