// Pins and handles in the window: dragged, rotated, set and removed with the mouse.
#include <glm/geometric.hpp>

#include "gelatin/simulator.h"
#include "viewer/support/window_test.h"

namespace gelatin::test {
namespace {

class HandlesWindowHeavy : public WindowHeavy {
protected:
    // A bar that is pinned at its left.
    static std::string bar() {
        return "[simulation]\n"
               "frame_rate = 50\n"
               "substeps = 1\n"
               "gravity = [0, -2, 0]\n"
               "[[material]]\n"
               "name = 'jelly'\n"
               "youngs_modulus = 2e5\n"
               "damping = 0.02\n"
               "[[object]]\n"
               "name = 'bar'\n"
               "shape = { box = [1.2, 0.4, 0.4], segments = [6, 2, 2] }\n"
               "position = [0, 1, 0]\n"
               "pins = [{ plane = [1, 0, 0], offset = -0.59 }]\n"
               "[[collider]]\n"
               "shape = { plane = [0, 1, 0] }\n"
               "[camera]\n"
               "eye = [0, 1, 5]\n"
               "target = [0, 1, 0]\n";
    }

    const HeldNodes& held(std::size_t index = 0) const { return session().held_nodes().at(index); }

    // Where a point shows in the window, as xdotool wants it.
    std::vector<std::string> mouse_at(const glm::dvec3& point, int right = 0, int up = 0) {
        const glm::vec2 place = app().camera().place_of(glm::vec3(point)).value();
        const auto pixel = [](float x) { return static_cast<int>(std::lround(x)); };
        const int x = pixel(0.5f * kWidth + place.x * kHeight) + right;
        const int y = pixel(0.5f * kHeight - place.y * kHeight) - up;
        return {"mousemove", std::to_string(x), std::to_string(y)};
    }

    void settle() {
        draw_until([&] { return !session().is_computing(); });
    }
    void wait(double simulated) {
        const double until = session().time() + simulated;
        draw_until([&] { return session().time() >= until; });
        settle();
    }
    double height_of_bar() const {
        const std::vector<float> p = session().simulator().read_frame().positions;
        double sum = 0.0;
        for (std::size_t k = 1; k < p.size(); k += 3) sum += static_cast<double>(p[k]);
        return sum / static_cast<double>(p.size() / 3);
    }
};

TEST_F(HandlesWindowHeavy, APinIsDraggedAndStaysThere) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        open(bar(), backend);
        const render::Camera before = app().camera().camera();
        const glm::dvec3 start = held().center;
        act(mouse_at(start));
        draw(2);
        act({"mousedown", "1"});
        draw(2);
        act(mouse_at(start, 40, 60));
        draw_until([&] { return held().drag == held().target && held().target != Drag(); });
        // 480 pixels are the height of the picture at a depth of 5 m.
        const double metre = 480.0 / (2.0 * 5.0 * std::tan(glm::radians(17.5)));
        EXPECT_LT(glm::distance(held().center - start, glm::dvec3(40.0, 60.0, 0.0) / metre), 0.01);
        act({"click", "4", "click", "4"});
        draw_until([&] { return held().target.move.z < -0.3; });
        act({"mouseup", "1"});
        draw(2);
        const Drag left = held().target;
        act({"mousemove", "320", "240"});
        wait(0.5);
        EXPECT_EQ(held().drag, left) << "it stays where it was left";
        EXPECT_EQ(app().camera().camera(), before);
        EXPECT_GT(height_of_bar(), 1.1) << "and the bar with it";
        press("r");
        draw_until([&] { return held().target == Drag(); });
        close();
    }
}

TEST_F(HandlesWindowHeavy, WithControlItTurns) {
    open(bar());
    const glm::dvec3 start = held().center;
    act(mouse_at(start));
    draw(2);
    act({"keydown", "ctrl", "mousedown", "1"});
    draw(2);
    act(mouse_at(start, 0, 48));
    draw(2);
    act({"mouseup", "1", "keyup", "ctrl"});
    draw_until([&] { return held().drag == held().target && held().target != Drag(); });
    EXPECT_EQ(held().target.move, glm::dvec3(0.0));
    const double angle = 0.1 * static_cast<double>(viewer::CameraController::kTurn);
    EXPECT_NEAR(glm::angle(held().drag.turn), angle, 0.05 * angle);
    EXPECT_LT(glm::distance(glm::axis(held().drag.turn), glm::dvec3(-1.0, 0.0, 0.0)), 0.05);
}

// The marker under the pointer stands out, with its name; without the check mark there are none.
TEST_F(HandlesWindowHeavy, MarkersShowAndAnswerThePointer) {
    open(bar());
    press("space");
    settle();
    press("Tab");
    const render::Image plain = picture();
    act(mouse_at(held().center));
    draw(3);
    const render::Image pointed = picture();
    EXPECT_NE(pointed.pixels, plain.pixels);
    act({"mousemove", "320", "400"});
    draw(3);
    EXPECT_EQ(picture().pixels, plain.pixels);
}

TEST_F(HandlesWindowHeavy, ABodyInHandIsPinnedAndFreedAgain) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        open(two_cubes(), backend);
        press("Tab");
        draw_until([&] { return session().time() > 0.3; });
        act({"mousemove", "320", "250", "mousedown", "1"});
        draw_until([&] { return session().hand() == viewer::Session::Hand::holding; });
        act({"mousemove", "320", "130"});
        wait(0.6);
        press("p");
        draw_until([&] { return session().held_nodes().size() == 1; });
        act({"mouseup", "1"});
        wait(0.6);
        const double height = held().center.y;
        EXPECT_GT(height, 1.0) << "it hangs in the air";
        EXPECT_EQ(session().scene().objects[0].handles.size(), 1u);
        wait(0.2);
        EXPECT_EQ(held().center.y, height);

        act(mouse_at(held().center));
        draw(2);
        press("p");
        draw_until([&] { return session().held_nodes().empty(); });
        wait(0.3);
        const std::vector<float> p = session().simulator().read_frame().positions;
        const Range& nodes = session().model().objects[0].nodes;
        double mean = 0.0;
        for (std::size_t n = nodes.first; n < nodes.end(); ++n)
            mean += static_cast<double>(p[3 * n + 1]) / nodes.count;
        EXPECT_LT(mean, height - 0.2) << "it falls";
        close();
    }
}

TEST_F(HandlesWindowHeavy, WhatIsDraggedIsSaved) {
    open(bar());
    act(mouse_at(held().center));
    draw(2);
    act({"mousedown", "1"});
    draw(2);
    act(mouse_at(held().center, 0, 50));
    draw_until([&] { return held().drag == held().target && held().target != Drag(); });
    act({"mouseup", "1"});
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(path(""));
    press("ctrl+s");
    std::filesystem::current_path(before);
    ASSERT_EQ(app().notice(), "saved scene-1.toml");
    const Scene scene = load_scene(path("scene-1.toml"));
    EXPECT_TRUE(scene.objects[0].pins.empty());
    ASSERT_EQ(scene.objects[0].handles.size(), 1u);
    EXPECT_LT(glm::distance(scene.objects[0].handles[0].drag.move, held().target.move), 1e-9);
}

}  // namespace
}  // namespace gelatin::test
