#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <optional>
#include <span>

#include "gl/program.h"
#include "render/camera.h"
#include "render/depth_splats.h"
#include "render/surface_draw.h"
#include "render/target.h"

namespace gelatin::render {

/// The maps' resolutions [pixels a side].
struct ShadowDetail {
    int key_map, undersides;  ///< what stands before the key light, and over the floor
    int floor_light;          ///< the light that reaches the floor
    bool few_taps;            ///< half the samples of the maps
    bool splat;               ///< casters drawn by DepthSplats, which is for small maps
};

/// What stands between the lights and the scene: a depth map seen from the key light, and from it and the
/// bodies' undersides the light that reaches the floor, as a small texture.
class Shadows {
public:
    explicit Shadows(const ShadowDetail& detail);
    Shadows(const Shadows&) = delete;
    Shadows& operator=(const Shadows&) = delete;
    ~Shadows();

    /// Fits the maps to what casts shadows. @param extent of the scene, which softness goes by [m], > 0
    /// @param to_light unit vector
    void aim(const Bounds& casters, float extent, float floor_height, const glm::vec3& to_light);

    /// Draws the casters into the maps. @pre a vertex array object is bound
    /// @param lights_floor false: where no floor shows, nothing of its light is worked out and all of it is
    /// lit
    void draw(std::initializer_list<const SurfaceDraw*> casters, bool lights_floor);

    /// The part of the floor that may be darkened.
    Bounds floor_patch() const;

    /// For programs that use shaders/render/include/light.glsl or floor_light.glsl.
    void set_uniforms(const gl::Program& program) const;
    /// For programs that include render/include/light.glsl.
    void bind_textures(const gl::Program& program) const;
    /// For programs that include render/include/floor_light.glsl.
    void bind_floor_light(const gl::Program& program) const;

private:
    void draw_depths(std::span<const DepthMap> maps, std::initializer_list<const SurfaceDraw*> casters);
    void set_penumbra(const gl::Program& program) const;
    void draw_cut_depth(const DepthMap& map, const SurfaceDraw& caster);
    void draw_floor_visibility() const;
    void draw_floor_light() const;

    gl::Program depth_program_;
    std::optional<gl::Program> cut_depth_program_;  // once something is cut open
    gl::Program floor_program_;
    gl::Program blend_program_;
    std::optional<DepthSplats> splats_;
    Target shadow_map_;
    Target underside_;
    Target floor_visibility_;
    Target floor_light_;
    unsigned compare_sampler_ = 0;

    glm::mat4 world_to_light_{1.0f};  // clip coordinates of the key light's map
    glm::mat4 world_to_floor_{1.0f};  // clip coordinates of the undersides' map
    glm::vec3 light_size_{1.0f};      // what the key light's map covers, across, up and in depth [m]
    glm::vec2 patch_corner_{0.0f};    // [m]
    glm::vec2 patch_size_{1.0f};      // [m]
    float floor_height_ = 0.0f;       // [m]
    bool lights_floor_ = true;
    float extent_ = 1.0f;  // of the scene [m]
};

}  // namespace gelatin::render
