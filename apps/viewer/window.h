#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "input.h"

struct GLFWwindow;

namespace gelatin::viewer {

struct WindowSettings {
    int width = 1280, height = 720;  ///< in units of a screen of usual density
    bool gl_debug = false;           ///< the driver's messages go to gl::debug
};

/// A window with an OpenGL 4.3 context, current on the calling thread, and Dear ImGui over it. One at a time.
class Window {
public:
    /// @throws SystemError if there is no display; NoOpenGl if it has no OpenGL 4.3.
    explicit Window(const WindowSettings& settings);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    bool is_asked_to_close() const;
    void ask_to_close();
    void hide();

    /// Collects events and begins a picture; panels may be drawn until draw_panels. Waits for events, but at
    /// most `patience` [s].
    void begin_frame(double patience);

    /// The events since the last call, except those that panels use.
    std::vector<Event> take_events();

    /// True if the pointer is over a panel, or a panel is using the mouse.
    bool is_over_panel() const;

    /// Copies a framebuffer of the window's size behind the panels; 0: a plain colour.
    void show_picture(unsigned framebuffer);

    /// Draws the panels over it: then everything is in framebuffer 0.
    void draw_panels();
    /// Shows the picture.
    void present();

    glm::ivec2 pixels() const;              ///< of the picture; 0 while the window is hidden
    float scale() const { return scale_; }  ///< of text and panels: 2 on a screen of twice the usual density
    double now() const;                     ///< [s]
    void set_title(const std::string& title);

private:
    friend struct WindowCallbacks;
    void set_scale(float scale);
    glm::vec2 place_of(double x, double y) const;

    GLFWwindow* window_ = nullptr;
    std::string title_;
    float scale_ = 1.0f;
    float new_scale_ = 1.0f;  // events from the screen since
    std::vector<Event> events_;
    glm::vec2 pointer_{0.0f};  // after the last of them
    double next_frame_ = 0.0;  // [s]
};

}  // namespace gelatin::viewer
