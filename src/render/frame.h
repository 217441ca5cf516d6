#pragma once

#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/camera.h"
#include "render/shadows.h"
#include "render/surface_draw.h"
#include "render/target.h"

namespace gelatin::render {

/// The view of the studio, and the properties that do not change while bodies move.
struct View {
    Camera camera;
    int width = 1, height = 1;          ///< [pixels]
    Bounds bounds;                      ///< determines the scale of floor and light [m]
    std::optional<float> floor_height;  ///< [m]; empty: no floor

    bool operator==(const View&) const = default;

    /// The pixels in which anything inside `box` is visible; all if some of it is behind the eye.
    PixelRect pixels_of(const Bounds& box) const;

    /// How large the scene is [m], > 0.
    float extent() const;
    /// The factor by which lines are wider in larger pictures.
    float line_scale() const;
    int letter_size() const;  ///< [pixels]: an em
    bool shows_floor() const { return floor_height && camera.eye.y > *floor_height; }

    /// The camera and the key light, for the programs in shaders/render.
    void set_uniforms(const gl::Program& program) const;
};

/// Unit vector to the key light.
glm::vec3 to_key_light();

/// Surfaces of one kind.
struct Layer {
    const SurfaceDraw& surfaces;
    const gl::BufferTexture& colors;  ///< linear RGB by object
    float jelly;                      ///< 1: soft and glossy; 0: matt
};

class Overlay;

/// The surfaces to draw. @pre the shadows are those of bodies and props
struct Frame {
    const View& view;
    Layer bodies, props;
    std::optional<Bounds> bounds;  ///< of bodies and props; empty: unknown
    const Shadows& shadows;
    const Overlay& overlay;
};

}  // namespace gelatin::render
