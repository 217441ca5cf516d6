#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/file.h"
#include "render/image.h"
#include "support/environment.h"
#include "viewer/support/display.h"
#include "viewer/viewer_app.h"

namespace gelatin::test {

/// Drives the real window by real keys and a real mouse. Skipped without a display for it, unless
/// GELATIN_REQUIRE_GL=1. A debug message or an error of OpenGL that is left when the test ends fails it, and
/// so does any object of OpenGL that outlives what happened in the window.
class WindowHeavy : public testing::Test {
protected:
    static constexpr int kWidth = 640, kHeight = 480;

    void SetUp() override;
    void TearDown() override;

    /// Opens a window on a scene; `text` is its file's. The pointer is in the middle.
    void open(const std::string& text, Backend backend = Backend::automatic,
              render::Quality quality = render::Quality::automatic);
    /// The same of a scene file or a mesh; empty: on the start screen.
    void open_file(const std::filesystem::path& file, Backend backend = Backend::automatic,
                   render::Quality quality = render::Quality::automatic);
    /// Closes it, with all that TearDown checks.
    void close();
    /// Two cubes, the smaller at the right, above a floor.
    static std::string two_cubes();

    /// Draws pictures until something holds; fails after ten seconds.
    void draw_until(const std::function<bool()>& holds);
    void draw(int pictures);

    void act(const std::vector<std::string>& actions) { VirtualDisplay::instance().act(actions); }
    /// Presses a key, by xdotool's name, and draws until the window has seen it.
    void press(const std::string& key);

    /// What is in the window now, panels and all.
    render::Image picture() const;

    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

    viewer::ViewerApp& app() { return *app_; }
    const viewer::Session& session() const { return *app_->session(); }
    viewer::Window& window() { return *window_; }

private:
    TemporaryFolder folder_;
    const EnvironmentVariable state_{"XDG_STATE_HOME", path("state").string()};  // files opened last
    std::unique_ptr<viewer::Window> window_;
    std::map<std::string, int> own_objects_;  // the window's own
    std::unique_ptr<viewer::ViewerApp> app_;
};

}  // namespace gelatin::test
