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
#include "render/line_overlay.h"
#include "render/spring_overlay.h"

namespace gelatin::render {

/// Draws the overlays of a view: over a picture, or the bodies instead of the pipeline. Nothing is compiled
/// or drawn before a view asks for it. Needs the context in which it was made.
class Overlay {
public:
    /// Sets what the next frame shows; valid as long as the view.
    void show(const RenderView& bodies, int letter_size);

    bool is_empty() const;
    /// True if this draws the bodies: transparent, coloured or cut open.
    bool replaces_bodies() const { return has_springs() || view().color_map || view().cut; }

    /// Draws the bodies, if they are opaque. @pre as Pipeline::draw, the shadows' textures are bound, and
    /// replaces_bodies
    void draw_bodies(const Frame& frame) const;
    /// Draws over the picture, using its depth. @pre as Pipeline::draw. Does not change alpha.
    void draw(const Frame& frame) const;

private:
    const OverlayView& view() const { return bodies_.overlay; }
    bool has_springs() const { return view().springs != 0; }
    bool shows_pressures() const {
        return !has_springs() && view().color_map && view().color_map->quantity == Quantity::pressure;
    }

    RenderView bodies_;
    std::optional<BodyOverlay> recolored_;
    std::optional<CutOverlay> cut_;
    std::optional<SpringOverlay> springs_;
    std::optional<FaceOverlay> faces_;
    std::optional<BoxOverlay> boxes_;
    std::optional<ArrowOverlay> arrows_;
    std::optional<LineOverlay> lines_;
    std::optional<LabelOverlay> labels_;
    std::optional<Legend> legend_;
};

}  // namespace gelatin::render
