#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "gelatin/scene.h"
#include "gelatin/views.h"
#include "render/camera.h"
#include "session.h"

namespace gelatin::viewer {

/// What panels know of the window.
struct PanelState {
    float scale = 1.0f;            ///< of the screen's density
    double picture_rate = 0.0;     ///< pictures a second
    const char* quality = "high";  ///< of the picture
    Overlays overlays;
    render::Camera camera;  ///< of the picture
    Scene edited;           ///< the session's scene as the user wants it by now
};

/// What the user asked for in the panels while one picture was drawn.
struct Requests {
    std::vector<Command> commands;
    std::optional<double> speed;
    std::optional<Overlays> overlays;
    std::optional<Scene> edited;
    std::optional<std::filesystem::path> opened;
};

/// The panels draw themselves with Dear ImGui and say what was asked for. @pre between Window::begin_frame
/// and Window::draw_panels
///
/// All that concerns a session, at the right edge: the lower left corner is for the legends of overlays.
void draw_session_panel(const Session& session, const PanelState& state, Requests& requests);
void draw_playback(const Session& session, const PanelState& state, Requests& requests);
void draw_settings(const PanelState& state, Requests& requests);
void draw_readings(const Session& session, const PanelState& state);
void draw_overlay_choices(const Session& session, const PanelState& state, Requests& requests);

/// What keys and mouse do.
void draw_help(float scale, Requests& requests);
/// Where to begin: the scenes that come with Gelatin.
void draw_start_screen(float scale, const std::vector<std::filesystem::path>& samples, Requests& requests);
/// A line at the lower edge.
void draw_notice(float scale, const std::string& text);
/// Something went wrong, in the middle. @return false once the user has seen it
bool draw_problem(float scale, const std::string& text);

}  // namespace gelatin::viewer
