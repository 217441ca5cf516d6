#pragma once

namespace gelatin::viewer {

/// The commands of keys and buttons.
enum class Command {
    toggle_play,
    step,
    step_frame,
    reset,
    reload,
    throw_body,
    pin,
    attach,
    slower,
    faster,
    frame_all,
    toggle_boxes,
    toggle_faces,
    toggle_springs,
    toggle_cut,
    toggle_stretch,
    toggle_stress,
    toggle_speed,
    toggle_pressure,
    toggle_arrows,
    toggle_contact_forces,
    toggle_wireframe,
    toggle_objects,
    toggle_attachments,
    toggle_bones,
    toggle_start_screen,
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
