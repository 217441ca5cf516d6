#pragma once

namespace gelatin::viewer {

/// Colours, sizes and font of the panels. @param scale 1 on a screen of usual density. @pre a context of Dear
/// ImGui; its previous font texture is discarded
void apply_theme(float scale);

}  // namespace gelatin::viewer
