#pragma once

#include <optional>

#include "command.h"
#include "gelatin/views.h"
#include "render/camera.h"

namespace gelatin::viewer {

/// What overlays begin with where they are turned on.
constexpr float kUsualStrain = 0.1f;
constexpr int kUsualBoxLevels = 2;
constexpr float kUsualArrowTime = 0.1f;  ///< [s]

/// What is shown after a key that turns something on or off; empty where the command is another.
std::optional<Overlays> toggled(Overlays overlays, Command command, const RenderView& bodies,
                                const render::Camera& camera);

/// Springs and quantities colour the bodies in their own ways: what is chosen takes the other's place.
void show_springs(Overlays& overlays, bool shown);
void show_quantity(Overlays& overlays, std::optional<Quantity> quantity);

/// Through the middle of the bodies, across the axis that the eye looks along most, open towards it.
CutPlane cut_towards(const render::Camera& camera, const RenderView& bodies);

/// The least and the greatest offset of planes of this direction that meet the bodies [m].
struct OffsetRange {
    float least, most;
};
OffsetRange offsets_through(const RenderView& bodies, const CutPlane& cut);

}  // namespace gelatin::viewer
