#pragma once

#include <optional>

#include "command.h"
#include "gelatin/views.h"
#include "render/camera.h"

namespace gelatin::viewer {

/// The initial values of overlays that are switched on.
constexpr float kUsualStrain = 0.1f;
constexpr int kUsualBoxLevels = 2;
constexpr float kUsualArrowTime = 0.1f;  ///< [s]

/// The overlays after a command that switches one; empty if the command is another.
std::optional<Overlays> toggled(Overlays overlays, Command command, const RenderView& bodies,
                                const render::Camera& camera);

/// Springs and quantities both colour the bodies: the new choice replaces the other.
void show_springs(Overlays& overlays, bool shown);
void show_quantity(Overlays& overlays, std::optional<Quantity> quantity);

/// A cut through the centre of the bodies, perpendicular to the axis nearest to the line of sight, open
/// towards the eye.
CutPlane cut_towards(const render::Camera& camera, const RenderView& bodies);

/// The smallest and the largest offset of planes with this normal that intersect the bodies [m].
struct OffsetRange {
    float least, most;
};
OffsetRange offsets_through(const RenderView& bodies, const CutPlane& cut);

}  // namespace gelatin::viewer
