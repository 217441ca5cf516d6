#pragma once

#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/camera.h"
#include "render/shadows.h"
#include "render/surface_draw.h"
#include "render/target.h"

namespace gelatin::render {

/// From where the studio is seen, and what of it stays the same while bodies move.
struct View {
    Camera camera;
    int width = 1, height = 1;          ///< [pixels]
    Bounds bounds;                      ///< what the scale of floor and light goes by [m]
    std::optional<float> floor_height;  ///< [m]; empty: no floor

    bool operator==(const View&) const = default;

    /// The pixels in which anything inside of `box` shows; all where some of it lies behind the eye.
    PixelRect pixels_of(const Bounds& box) const;

    /// How large the scene is [m], > 0.
    float extent() const;
    /// How much wider lines are drawn in larger pictures.
    float line_scale() const;
    int letter_size() const;  ///< [pixels]: an em
    bool shows_floor() const { return floor_height && camera.eye.y > *floor_height; }

    /// The camera and the key light, for programs of the folder shaders/render.
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

/// What is drawn now. @pre the shadows are those of bodies and props
struct Frame {
    const View& view;
    Layer bodies, props;
    std::optional<Bounds> bounds;  ///< of bodies and props; empty: not known
    const Shadows& shadows;
    const Overlay& overlay;
};

}  // namespace gelatin::render
