// The start screen: what it opens, by mouse and by keys.
#include <fmt/core.h>

#include "core/file.h"
#include "render/image.h"
#include "viewer/support/window_test.h"

namespace gelatin::test {
namespace {

namespace fs = std::filesystem;

class StartWindowHeavy : public WindowHeavy {
protected:
    // Thirty scenes, more than fit, the first with a picture; three entries of files opened last.
    void open_start_screen() {
        fs::create_directories(path("scenes/pictures"));
        for (int i = 0; i < 30; ++i)
            write_file(path(fmt::format("scenes/s{:02}.toml", i)), "# Cubes fall.\n" + two_cubes());
        render::Image red(320, 180);
        for (std::size_t k = 0; k < red.pixels.size(); k += 3) red.pixels[k] = 255;
        render::write_png(path("scenes/pictures/s00.png"), red);
        write_file(path("scenes/pictures/s01.png"), "no picture");
        write_file(path("mine.toml"), two_cubes());
        fs::create_directories(path("state/gelatin"));
        write_file(path("state/gelatin/recent"),
                   fmt::format("{}\nno path\n{}\n", path("mine.toml").string(), path("gone.toml").string()));
        const fs::path before = fs::current_path();
        fs::current_path(path(""));
        open_file({});
        fs::current_path(before);
    }
    const viewer::StartScreen& screen() { return app().start_screen(); }
    void click(std::size_t item) {
        const viewer::ItemBox& box = screen().boxes().at(item);
        act({"mousemove", std::to_string(static_cast<int>(0.5f * (box.low.x + box.high.x))),
             std::to_string(static_cast<int>(0.5f * (box.low.y + box.high.y))), "click", "1"});
    }
    fs::path opened() { return session().scene().file.filename(); }
};

TEST_F(StartWindowHeavy, ShowsPicturesWhereThereAreSome) {
    open_start_screen();
    ASSERT_EQ(screen().item_count(), 32u);
    const viewer::ItemBox& first = screen().boxes().at(2);
    const render::Image now = picture();
    const auto x = static_cast<int>(0.5f * (first.low.x + first.high.x));
    const std::uint8_t* pixel = now.at(x, static_cast<int>(first.low.y) + 30);
    EXPECT_GT(pixel[0], 240);
    EXPECT_LT(pixel[1], 10);
    const viewer::ItemBox& second = screen().boxes().at(3);
    EXPECT_LT(now.at(static_cast<int>(second.low.x) + 30, static_cast<int>(second.low.y) + 30)[0], 60);
}

TEST_F(StartWindowHeavy, AClickOpensAScene) {
    open_start_screen();
    const fs::path before = fs::current_path();
    fs::current_path(path(""));
    click(3);
    draw_until([&] { return app().session() != nullptr; });
    fs::current_path(before);
    EXPECT_EQ(opened(), "s01.toml");
    EXPECT_FALSE(app().shows_start_screen());
    const std::string list = read_file(path("state/gelatin/recent"));
    EXPECT_EQ(list.find("s01.toml\n") + 9, list.find('\n') + 1) << list;
    EXPECT_NE(list.find("mine.toml"), std::string::npos);
}

TEST_F(StartWindowHeavy, AClickOpensWhatWasOpenedLast) {
    open_start_screen();
    click(0);
    draw_until([&] { return app().session() != nullptr; });
    EXPECT_EQ(opened(), "mine.toml");
}

TEST_F(StartWindowHeavy, AFileThatIsGoneGivesAMessage) {
    open_start_screen();
    click(1);
    draw_until([&] { return !app().problem().empty(); });
    EXPECT_EQ(app().problem(), path("gone.toml").string() + ": no such file");
    press("Escape");
    EXPECT_TRUE(app().shows_start_screen());
    fs::remove(path("mine.toml"));  // meanwhile
    click(0);
    draw_until([&] { return !app().problem().empty(); });
    EXPECT_EQ(app().problem(), path("mine.toml").string() + ": no such file");
}

TEST_F(StartWindowHeavy, KeysChooseAndTheSelectionStaysInView) {
    open_start_screen();
    for (const char* key : {"Home", "Right", "Down", "Right"}) press(key);
    EXPECT_EQ(screen().selected(), 3u);
    press("End");
    draw(2);
    EXPECT_EQ(screen().selected(), 31u);
    EXPECT_LE(screen().boxes().at(31).high.y, static_cast<float>(kHeight));
    EXPECT_LT(screen().boxes().at(0).high.y, 0.0f) << "it has scrolled";
    const fs::path before = fs::current_path();
    fs::current_path(path(""));
    press("Return");
    draw_until([&] { return app().session() != nullptr; });
    fs::current_path(before);
    EXPECT_EQ(opened(), "s29.toml");
}

TEST_F(StartWindowHeavy, TheWheelScrolls) {
    open_start_screen();
    const float before = screen().boxes().at(2).low.y;
    act({"click", "5", "click", "5"});
    draw(3);
    EXPECT_LT(screen().boxes().at(2).low.y, before - 20.0f);
    act({"click", "4", "click", "4", "click", "4"});
    draw(3);
    EXPECT_EQ(screen().boxes().at(2).low.y, before);
}

TEST_F(StartWindowHeavy, ComesOverASceneAndGoes) {
    open(two_cubes());
    press("space");
    draw_until([&] { return !session().is_computing(); });
    draw(2);
    const double time = session().time();
    press("g");
    EXPECT_TRUE(app().shows_start_screen());
    press("Right");  // chooses, and makes no step
    draw(2);
    EXPECT_TRUE(screen().selected().has_value());
    EXPECT_EQ(session().time(), time);
    press("Escape");
    EXPECT_FALSE(app().shows_start_screen());
    press("Right");
    draw_until([&] { return session().time() > time; });
}

}  // namespace
}  // namespace gelatin::test
