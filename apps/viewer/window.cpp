#include "window.h"

#include <epoxy/gl.h>
// After OpenGL's functions, which GLFW would otherwise declare itself.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "core/log.h"
#include "gelatin/error.h"
#include "gl/context.h"
#include "gl/debug.h"
#include "gl/hazards.h"
#include "theme.h"

namespace gelatin::viewer {
namespace {

constexpr double kMostPictures = 60.0;  // pictures per second, if the driver does not wait for the screen

// GLFW reports the cause of an error through a callback only.
std::string last_glfw_problem() {
    const char* description = nullptr;
    glfwGetError(&description);
    std::string problem = description == nullptr ? "no reason given" : description;
    while (!problem.empty() && problem.back() == ' ') problem.pop_back();
    return problem;
}

}  // namespace

/// GLFW's callbacks while events are polled.
struct WindowCallbacks {
    static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

    // The pointer may have moved between an event and its callback.
    static glm::vec2 pointer(GLFWwindow* window) { return of(window).pointer_; }
    static void key(GLFWwindow* window, int key, int, int action, int modifiers) {
        if (action == GLFW_RELEASE) return;
        of(window).events_.emplace_back(KeyPress{key, (modifiers & GLFW_MOD_CONTROL) != 0,
                                                 (modifiers & GLFW_MOD_SHIFT) != 0, action == GLFW_REPEAT});
    }
    static void button(GLFWwindow* window, int button, int action, int modifiers) {
        of(window).events_.emplace_back(
            ButtonChange{button, action == GLFW_PRESS, (modifiers & GLFW_MOD_CONTROL) != 0, pointer(window)});
    }
    static void move(GLFWwindow* window, double x, double y) {
        of(window).pointer_ = of(window).place_of(x, y);
        of(window).events_.emplace_back(PointerMove{pointer(window)});
    }
    static void wheel(GLFWwindow* window, double, double notches) {
        of(window).events_.emplace_back(WheelTurn{static_cast<float>(notches), pointer(window)});
    }
    static void drop(GLFWwindow* window, int count, const char** names) {
        of(window).events_.emplace_back(FileDrop{{names, names + count}});
    }
    static void rescale(GLFWwindow* window, float x, float y) { of(window).new_scale_ = std::max(x, y); }
};

Window::Window(const WindowSettings& settings) {
    if (glfwInit() == GLFW_FALSE) {
        throw SystemError("there is no display to open a window on (" + last_glfw_problem() +
                          "); `gelatin run SCENE --video FILE.mp4` needs none");
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, settings.gl_debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // pictures have their own depth buffers
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_TRUE);
    title_ = "Gelatin";
    window_ = glfwCreateWindow(settings.width, settings.height, title_.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        const std::string problem = last_glfw_problem();
        glfwTerminate();
        throw NoOpenGl("no window with OpenGL 4.3 can be opened (" + problem +
                       "): install a driver that has it");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    if (settings.gl_debug) {
        gl::enable_debug_output();
        gl::enable_hazard_tracking();
    }

    // Before Dear ImGui, which chains to earlier callbacks.
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, WindowCallbacks::key);
    glfwSetMouseButtonCallback(window_, WindowCallbacks::button);
    glfwSetCursorPosCallback(window_, WindowCallbacks::move);
    glfwSetScrollCallback(window_, WindowCallbacks::wheel);
    glfwSetDropCallback(window_, WindowCallbacks::drop);
    glfwSetWindowContentScaleCallback(window_, WindowCallbacks::rescale);

    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // writes no settings file
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 430 core");
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    new_scale_ = std::max(x, y);
    set_scale(new_scale_);
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

bool Window::is_asked_to_close() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::ask_to_close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::hide() {
    glfwHideWindow(window_);
    glfwPollEvents();
}

void Window::begin_frame(double patience) {
    if (patience > 0.0) {
        glfwWaitEventsTimeout(patience);
    } else {
        glfwPollEvents();
    }
    if (new_scale_ != scale_) {
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        set_scale(new_scale_);
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Window::set_scale(float scale) {
    scale_ = scale;
    apply_theme(scale);
}

std::vector<Event> Window::take_events() {
    const ImGuiIO& io = ImGui::GetIO();
    std::vector<Event> events = std::exchange(events_, {});
    std::erase_if(events, [&](const Event& event) {
        if (std::holds_alternative<KeyPress>(event)) return io.WantTextInput;
        const auto* button = std::get_if<ButtonChange>(&event);
        const bool begins =
            (button != nullptr && button->is_down) || std::holds_alternative<WheelTurn>(event);
        return begins && io.WantCaptureMouse;  // the end of a drag belongs to whoever began it
    });
    return events;
}

bool Window::is_over_panel() const {
    return ImGui::GetIO().WantCaptureMouse;
}

void Window::show_picture(unsigned framebuffer) {
    const glm::ivec2 size = pixels();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    if (framebuffer == 0) {
        glClearColor(0.13f, 0.14f, 0.16f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        return;
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glDisable(GL_SCISSOR_TEST);
    glBlitFramebuffer(0, 0, size.x, size.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

void Window::draw_panels() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    gl::check_errors("drawing the window");
}

void Window::present() {
    glfwSwapBuffers(window_);
    // Software drivers do not wait for a screen, and would take processor time from the simulation.
    if (const double early = next_frame_ - now(); early > 0.0)
        std::this_thread::sleep_for(std::chrono::duration<double>(early));
    next_frame_ = std::max(next_frame_ + 1.0 / kMostPictures, now());
}

glm::ivec2 Window::pixels() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

double Window::now() const {
    return glfwGetTime();
}

void Window::set_title(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(window_, title_.c_str());
}

glm::vec2 Window::place_of(double x, double y) const {
    int width = 1, height = 1;
    glfwGetWindowSize(window_, &width, &height);
    const glm::dvec2 from_center(x - 0.5 * width, 0.5 * height - y);
    return glm::vec2(from_center / static_cast<double>(std::max(height, 1)));
}

}  // namespace gelatin::viewer
