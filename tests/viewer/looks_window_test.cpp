// The window looks as it did: its start screen, a scene with its panels, the list of keys, an error.
#include <algorithm>
#include <cstdlib>
#include <glm/common.hpp>
#include <limits>

#include "support/image_compare.h"
#include "support/source_path.h"
#include "viewer/support/window_test.h"

namespace gelatin::test {
namespace {

namespace fs = std::filesystem;

constexpr int kTile = 20;  // of the halved picture [pixels]

// Every other pixel's mean with its neighbours: letters lose what fonts differ by.
render::Image halved(const render::Image& image) {
    render::Image half(image.width / 2, image.height / 2);
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            const glm::dvec3 color = glm::round(mean_color(image, 2 * x, 2 * y, 2, 2));
            for (int k = 0; k < 3; ++k) half.at(x, y)[k] = static_cast<std::uint8_t>(color[k]);
        }
    }
    return half;
}

// The largest difference of a tile's mean colour: a panel that is elsewhere, a word or a button too few.
double worst_tile(const render::Image& a, const render::Image& b) {
    if (a.width != b.width || a.height != b.height) return std::numeric_limits<double>::infinity();
    double worst = 0.0;
    for (int y = 0; y < a.height; y += kTile) {
        for (int x = 0; x < a.width; x += kTile) {
            const glm::dvec3 difference =
                glm::abs(mean_color(a, x, y, kTile, kTile) - mean_color(b, x, y, kTile, kTile));
            worst = std::max({worst, difference.r, difference.g, difference.b});
        }
    }
    return worst;
}

constexpr double kMost = 12.0;  // of worst_tile, of 255: what other letters make

class LooksWindowHeavy : public WindowHeavy {
protected:
    static fs::path reference(const std::string& name) {
        return fs::path(test::source_path()) / "tests" / "viewer" / "references" / name;
    }

    void expect_looks_like(const std::string& name) {
        const render::Image now = halved(picture());
        if (std::getenv("GELATIN_UPDATE_REFERENCES") != nullptr) render::write_png(reference(name), now);
        EXPECT_LT(worst_tile(now, render::read_png(reference(name))), kMost)
            << name << ": if the new picture is better, set GELATIN_UPDATE_REFERENCES=1 once";
    }
};

// The second card of the start screen without its words.
TEST(WindowLooks, WordsTooFewAreNoticed) {
    const fs::path file = fs::path(test::source_path()) / "tests" / "viewer" / "references" / "start.png";
    render::Image image = render::read_png(file);
    const render::Image reference = image;
    for (int y = 122; y < 147; ++y) std::copy_n(image.at(162, 152), 3 * 140, image.at(162, y));
    EXPECT_GT(worst_tile(image, reference), kMost);
    EXPECT_EQ(worst_tile(reference, reference), 0.0);
}

TEST_F(LooksWindowHeavy, StartScreen) {
    open_file({});
    act({"mousemove", "5", "5"});
    draw(3);
    expect_looks_like("start.png");
}

TEST_F(LooksWindowHeavy, SceneAndHelp) {
    open(two_cubes());
    press("space");
    act({"mousemove", "5", "5"});
    press("r");
    draw_until([&] { return session().time() == 0.0; });
    for (int frame = 0; frame < 6; ++frame) {
        const double before = session().time();
        press("Right");
        draw_until([&] { return session().time() > before && !session().is_computing(); });
    }
    draw(3);
    expect_looks_like("scene.png");
    press("F1");
    expect_looks_like("help.png");
    press("Escape");
    expect_looks_like("scene.png");
}

TEST_F(LooksWindowHeavy, Error) {
    const fs::path before = fs::current_path();
    fs::current_path(path(""));
    write_file("wrong.toml", "[simulation]\nsolver = 'verlet'\n");
    open_file("wrong.toml");
    fs::current_path(before);
    act({"mousemove", "5", "5"});
    draw(3);
    expect_looks_like("error.png");
    press("Escape");
    EXPECT_EQ(app().problem(), "");
}

// However small the window is, what is in its middle fits.
TEST_F(LooksWindowHeavy, HelpInASmallWindow) {
    open_file({});
    act({"mousemove", "5", "5", "search", "--name", "Gelatin", "windowsize", "320", "240"});
    draw_until([&] { return window().pixels() == glm::ivec2(320, 240); });
    press("F1");
    expect_looks_like("small_help.png");
}

}  // namespace
}  // namespace gelatin::test
