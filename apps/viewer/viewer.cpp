#include "viewer.h"

#include "viewer_app.h"
#include "window.h"

namespace gelatin::viewer {

void run_viewer(const ViewerOptions& options) {
    Window window({options.width, options.height, options.gl_debug});
    ViewerApp app(window, options);
    while (!window.is_asked_to_close()) app.draw_frame();
    window.hide();  // background work may take a while to end
}

}  // namespace gelatin::viewer
