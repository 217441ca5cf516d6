#pragma once

#include <memory>
#include <optional>
#include <string>

#include "camera_controller.h"
#include "film.h"
#include "handle_drag.h"
#include "panels.h"
#include "render/renderer.h"
#include "scene_loader.h"
#include "session.h"
#include "shader_watch.h"
#include "start_screen.h"
#include "viewer.h"
#include "window.h"

namespace gelatin::viewer {

/// Everything that happens in the window. docs/viewer.md describes its parts.
class ViewerApp {
public:
    /// @param window must outlive it
    ViewerApp(Window& window, const ViewerOptions& options);
    ViewerApp(const ViewerApp&) = delete;
    ViewerApp& operator=(const ViewerApp&) = delete;
    /// Ends a running film.
    ~ViewerApp();

    /// One picture: the user's events, the simulation's results, panels.
    void draw_frame();

    /// A scene, or meshes; what was set for others does not count.
    void open(const std::vector<std::filesystem::path>& files);

    /// Null before a scene is loaded.
    const Session* session() const { return session_.get(); }
    const CameraController& camera() const { return camera_; }
    const PanelState& panels() const { return panels_; }
    /// The error that is shown; empty if there is none.
    const std::string& problem() const { return problem_; }
    const StartScreen& start_screen() const { return start_screen_; }
    /// Whether it can be seen: unless a message is.
    bool shows_start_screen() const {
        return problem_.empty() && !shows_help_ && (session_ ? shows_start_screen_ : !loader_.is_busy());
    }
    bool is_filming() const { return film_.has_value(); }
    /// The last line at the lower edge.
    const std::string& notice() const { return notice_; }

private:
    void take_loaded_scene();
    void show_scene(SceneLoader::Result result);
    void handle(const Event& event);
    void handle(const ButtonChange& button);
    void handle(const PointerMove& move);
    void handle(const WheelTurn& wheel);
    void follow_hand();
    void let_go();
    std::vector<Marker> markers() const;
    const Marker* pointed(const std::vector<Marker>& markers) const;
    bool take_handle(bool turns);
    void pin();
    bool click_to_attach(const ButtonChange& button);
    void begin_to_attach();
    void follow_attach_tool();
    void draw_attach_tool();
    void obey(Command command);
    void obey(const Requests& requests);
    void throw_body();
    std::string stem() const;
    void save_scene();
    void show_overlays(const Overlays& overlays);
    void draw_picture(bool is_new);
    void make_renderer(int width, int height);
    void reload_shaders();
    void toggle_film();
    void film_picture();
    void end_film();
    Requests draw_panels();
    void save_pictures();
    void save_picture(unsigned framebuffer, int width, int height);
    void notify(const std::string& notice);
    void fail(const std::string& problem);
    void update_title();
    double patience() const;
    float aspect() const;

    Window& window_;
    ViewerOptions options_;
    SceneLoader loader_;
    std::unique_ptr<Session> session_;
    std::unique_ptr<render::Renderer> renderer_;
    std::optional<Film> film_;
    ShaderWatch shader_watch_;
    render::Surroundings surroundings_;
    CameraController camera_;
    std::optional<render::Camera> drawn_camera_;  // of the picture; 0 before the first

    PanelState panels_;
    StartScreen start_screen_;
    bool shows_panels_ = true, shows_help_ = false;
    bool shows_start_screen_ = false;  // although there is a session
    bool wants_picture_ = false, wants_window_picture_ = false;
    std::string problem_, notice_, told_problem_;
    double notice_until_ = 0.0;  // [s]
    double last_frame_ = 0.0;    // [s]
    double opened_at_ = 0.0;     // start of the present loading [s]

    std::optional<int> dragging_;  // the button
    glm::vec2 pointer_{0.0f};
    std::size_t own_bodies_ = 0;  // number of objects of the scene as read; the others were thrown in
    bool is_hand_asked_ = false;  // whether the drag has met a body is not known yet
    glm::vec2 motion_since_asked_{0.0f};
    std::optional<float> hand_depth_;  // in front of the eye, while a body is held [m]
    std::optional<HandleDrag> handle_drag_;
};

}  // namespace gelatin::viewer
