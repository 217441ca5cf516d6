#pragma once

#include <optional>

#include "gelatin/views.h"
#include "render/arrow_overlay.h"
#include "render/body_overlay.h"
#include "render/box_overlay.h"
#include "render/cut_overlay.h"
#include "render/face_overlay.h"
#include "render/frame.h"
#include "render/label_overlay.h"
#include "render/legend.h"
#include "render/spring_overlay.h"

namespace gelatin::render {

/// Draws what a view shows beside the bodies over a picture, or of the bodies in place of the pipeline.
/// Nothing is made or drawn before a view asks for it. Needs the context it was made in.
class Overlay {
public:
    /// Takes what the next frame shows; as long-lived as the view.
    void show(const RenderView& bodies, int letter_size);

    bool is_empty() const;
    /// Bodies are drawn here: see-through, coloured or cut open.
    bool replaces_bodies() const { return has_springs() || view().color_map || view().cut; }

    /// The bodies, where they are solid. @pre as Pipeline::draw, the shadows' textures are bound, and
    /// replaces_bodies
    void draw_bodies(const Frame& frame) const;
    /// Draws over all that is in the picture, by its depth. @pre as Pipeline::draw. Keeps alpha as it is.
    void draw(const Frame& frame) const;

private:
    const OverlayView& view() const { return bodies_.overlay; }
    bool has_springs() const { return view().springs != 0; }

    RenderView bodies_;
    std::optional<BodyOverlay> recolored_;
    std::optional<CutOverlay> cut_;
    std::optional<SpringOverlay> springs_;
    std::optional<FaceOverlay> faces_;
    std::optional<BoxOverlay> boxes_;
    std::optional<ArrowOverlay> arrows_;
    std::optional<LabelOverlay> labels_;
    std::optional<Legend> legend_;
};

}  // namespace gelatin::render
