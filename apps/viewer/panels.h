#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "gelatin/scene.h"
#include "gelatin/views.h"
#include "markers.h"
#include "render/camera.h"
#include "session.h"

namespace gelatin::viewer {

/// What panels know about the window.
struct PanelState {
    float scale = 1.0f;            ///< of the screen's density
    double picture_rate = 0.0;     ///< pictures a second
    const char* quality = "high";  ///< of the picture
    Overlays overlays;
    render::Camera camera;      ///< of the picture
    bool shows_markers = true;  ///< of pins and handles
    Scene edited;               ///< the session's scene with the user's edits
};

/// The user's requests in the panels during one picture.
struct Requests {
    std::vector<Command> commands;
    std::optional<double> speed;
    std::optional<std::size_t> recorded;  ///< frame to show, by its index in the recording
    std::optional<Overlays> overlays;
    std::optional<bool> shows_markers;
    std::optional<Scene> edited;
    std::vector<std::size_t> detached;  ///< attachments, by their place in the scene; the same for motors
    std::vector<std::pair<std::size_t, JointMotor>> motors;
    std::vector<std::pair<std::size_t, CavityGas>> gas;  ///< by their place in Session::cavities()
    std::vector<std::filesystem::path> opened;           ///< a scene or meshes; empty: nothing
};

/// The panels are drawn with Dear ImGui and return requests. @pre between Window::begin_frame and
/// Window::draw_panels
///
/// All that concerns a session, at the right edge. The lower left corner is for the legends of overlays.
void draw_session_panel(const Session& session, const PanelState& state, Requests& requests);
void draw_playback(const Session& session, const PanelState& state, Requests& requests);
void draw_settings(const PanelState& state, Requests& requests);
void draw_readings(const Session& session, const PanelState& state);
/// @pre not of a recording
void draw_attachments(const Session& session, const PanelState& state, Requests& requests);
/// Without anything to edit where a recording is played.
void draw_cavities(const Session& session, Requests& requests);
void draw_overlay_choices(const Session& session, const PanelState& state, Requests& requests);

/// Over the picture and under the panels. @param pointed the one at the pointer; null: none
void draw_markers(float scale, const std::vector<Marker>& markers, const Marker* pointed);

/// The point that was clicked first, and a line to the pointer. As of markers.
void draw_first_point(float scale, const glm::vec2& place, const glm::vec2& pointer);

/// The list of keys and mouse gestures.
void draw_help(float scale, Requests& requests);
/// A line at the lower edge.
void draw_notice(float scale, const std::string& text);
/// An error message, in the middle. @return false once the user has closed it
bool draw_problem(float scale, const std::string& text);

}  // namespace gelatin::viewer
