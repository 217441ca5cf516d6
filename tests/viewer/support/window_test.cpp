#include "viewer/support/window_test.h"

#include <epoxy/gl.h>

#include <chrono>
#include <cstdlib>

#include "gl/debug.h"
#include "gl/hazards.h"
#include "render/frame_grabber.h"
#include "viewer/support/gl_objects.h"

namespace gelatin::test {

using Clock = std::chrono::steady_clock;

void WindowHeavy::SetUp() {
    const std::string& why_not = VirtualDisplay::instance().why_not();
    if (why_not.empty()) return;
    const char* required = std::getenv("GELATIN_REQUIRE_GL");
    if (required != nullptr && std::string(required) == "1") FAIL() << why_not;
    GTEST_SKIP() << why_not;
}

void WindowHeavy::TearDown() {
    close();
}

void WindowHeavy::close() {
    if (!window_) return;
    app_.reset();
    EXPECT_EQ(count_gl_objects(), own_objects_);
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    for (const std::string& message : gl::take_debug_messages()) ADD_FAILURE() << message;
    for (const std::string& hazard : gl::take_hazards()) ADD_FAILURE() << hazard;
    window_.reset();
}

void WindowHeavy::open(const std::string& text, Backend backend, render::Quality quality) {
    write_file(path("scene.toml"), text);
    open_file(path("scene.toml"), backend, quality);
}

void WindowHeavy::open_file(const std::filesystem::path& file, Backend backend, render::Quality quality) {
    viewer::ViewerOptions all;
    all.backend = backend;
    all.quality = quality;
    if (!file.empty()) all.input.files = {file};
    all.width = kWidth;
    all.height = kHeight;
    all.gl_debug = true;
    window_ = std::make_unique<viewer::Window>(viewer::WindowSettings{kWidth, kHeight, true});
    window_->begin_frame(0.0);  // Dear ImGui makes what it needs
    window_->draw_panels();
    own_objects_ = count_gl_objects();
    app_ = std::make_unique<viewer::ViewerApp>(*window_, all);
    act({"mousemove", std::to_string(kWidth / 2), std::to_string(kHeight / 2)});
    draw_until([&] { return file.empty() || app_->session() != nullptr || !app_->problem().empty(); });
    draw(2);  // a new window may still be about to get its keys
}

std::string WindowHeavy::two_cubes() {
    return "[simulation]\n"
           "frame_rate = 50\n"
           "substeps = 2\n"
           "solver = 'vbd'\n"
           "[[material]]\n"
           "name = 'jelly'\n"
           "youngs_modulus = 2e5\n"
           "[[object]]\n"
           "name = 'large'\n"
           "shape = { box = [1, 1, 1], segments = [3, 3, 3] }\n"
           "position = [0, 0.7, 0]\n"
           "[[object]]\n"
           "name = 'small'\n"
           "shape = { box = [0.5, 0.5, 0.5], segments = [3, 3, 3] }\n"
           "position = [1.5, 0.4, 0]\n"
           "[[collider]]\n"
           "shape = { plane = [0, 1, 0] }\n"
           "[camera]\n"
           "eye = [0, 1, 6]\n"
           "target = [0, 0.7, 0]\n";
}

void WindowHeavy::draw_until(const std::function<bool()>& holds) {
    const Clock::time_point end = Clock::now() + std::chrono::seconds(10);
    while (!holds()) {
        ASSERT_LT(Clock::now(), end) << "what was waited for does not come";
        app_->draw_frame();
    }
}

void WindowHeavy::draw(int pictures) {
    for (int i = 0; i < pictures; ++i) app_->draw_frame();
}

void WindowHeavy::press(const std::string& key) {
    act({"key", key});
    draw(2);
}

render::Image WindowHeavy::picture() const {
    // A software driver, as Xvfb has, copies what it presents, and keeps it.
    render::FrameGrabber grabber(window_->pixels().x, window_->pixels().y);
    grabber.grab(0);
    return grabber.flush().value();
}

}  // namespace gelatin::test
