#pragma once

#include <optional>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "render/frame.h"
#include "render/strain_legend.h"

namespace gelatin::render {

/// Draws what a view shows beside the bodies over a picture: marked faces, springs, boxes. Nothing is made or
/// drawn before a view asks for it. Needs the context it was made in.
class Overlay {
public:
    /// Takes what the next frame shows; as long-lived as the view.
    void show(const RenderView& bodies);

    bool is_empty() const { return !boxes_ && !faces_ && !springs_; }
    /// Springs are inside: bodies are drawn here, see-through.
    bool replaces_bodies() const { return springs_.has_value(); }

    /// Draws over all that is in the picture, by its depth. @pre as Pipeline::draw. Keeps alpha as it is.
    void draw(const Frame& frame) const;

private:
    // A view's buffers as textures.
    struct Boxes {
        gl::BufferTexture boxes, shown;
        std::uint32_t count;
    };
    struct Faces {
        gl::BufferTexture marks;
    };
    struct Springs {
        gl::BufferTexture positions, springs;
        std::uint32_t count;
        float full_strain;
    };
    void draw_boxes(const View& view) const;
    void draw_faces(const Frame& frame) const;
    void draw_springs(const Frame& frame) const;

    std::optional<Boxes> boxes_;
    std::optional<Faces> faces_;
    std::optional<Springs> springs_;
    std::optional<gl::Program> box_program_, face_program_, spring_program_, glass_program_;
    std::optional<StrainLegend> legend_;
};

}  // namespace gelatin::render
