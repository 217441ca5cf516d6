#pragma once

namespace gelatin::viewer {

/// What a user can ask for by a key or a button.
enum class Command {
    toggle_play,
    step,
    step_frame,
    reset,
    reload,
    throw_body,
    pin,
    slower,
    faster,
    frame_all,
    toggle_boxes,
    toggle_faces,
    toggle_strain,
    toggle_panels,
    save_scene,
    screenshot,
    screenshot_of_window,
    toggle_film,
    toggle_help,
    dismiss,
    quit,
};

}  // namespace gelatin::viewer
