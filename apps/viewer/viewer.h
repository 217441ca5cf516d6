#pragma once

#include "common/scene_input.h"
#include "gelatin/simulator.h"
#include "render/renderer.h"

namespace gelatin::viewer {

/// The options of `gelatin view`.
struct ViewerOptions {
    SceneInput input;  ///< no files: the start screen
    Backend backend = Backend::automatic;
    render::Quality quality = render::Quality::automatic;
    int width = 1280, height = 720;  ///< of the window
    bool gl_debug = false;
};

/// Opens a window and returns when the user has closed it.
/// @throws SystemError if there is no display; NoOpenGl if it has no OpenGL 4.3. Errors in a scene are shown
///   in the window and logged.
void run_viewer(const ViewerOptions& options);

}  // namespace gelatin::viewer
