// Attachments in the window: made by two clicks, detached in the panel, saved.
#include <glm/geometric.hpp>

#include "gelatin/simulator.h"
#include "viewer/support/window_test.h"

namespace gelatin::test {
namespace {

class AttachingWindowHeavy : public WindowHeavy {
protected:
    void settle() {
        draw_until([&] { return !session().is_computing(); });
        draw(2);
    }
    void click(int x, int y, bool with_control = false) {
        act({"mousemove", std::to_string(x), std::to_string(y)});
        draw(2);
        if (with_control) act({"keydown", "ctrl"});
        act({"click", "1"});
        draw(2);
        if (with_control) act({"keyup", "ctrl"});
        settle();
    }
    bool is_attached() const { return session().attachments().size() == 1; }
    // The large cube is in the middle, the small one at its right.
    void attach_cubes(bool by_rope) {
        press("a");
        click(300, 260);
        EXPECT_TRUE(session().attach_tool().first_point().has_value());
        click(500, 270, by_rope);
    }
    double center_height(std::size_t object) const {
        const std::vector<float> p = session().simulator().read_frame().positions;
        const Range& nodes = session().model().objects[object].nodes;
        double mean = 0.0;
        for (std::size_t n = nodes.first; n < nodes.end(); ++n)
            mean += static_cast<double>(p[3 * n + 1]) / nodes.count;
        return mean;
    }
};

TEST_F(AttachingWindowHeavy, TwoClicksAttach) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        open(two_cubes(), backend);
        press("space");
        press("Tab");
        settle();
        const render::Image plain = picture();
        attach_cubes(true);
        ASSERT_TRUE(is_attached()) << app().problem();
        EXPECT_EQ(app().notice(), "rope 1: 'large' to 'small'");
        EXPECT_EQ(session().scene().attachments[0].limits->x, 0.0);
        EXPECT_NE(picture().pixels, plain.pixels) << "it shows";
        press("r");
        draw_until([&] { return session().attachments().empty(); });
        close();
    }
}

// Thrown bodies make another simulator, which has them, too.
TEST_F(AttachingWindowHeavy, WhatIsAttachedToSpaceHangsThere) {
    open(two_cubes());
    press("space");
    press("Tab");
    press("a");
    click(320, 200);
    click(320, 20);
    ASSERT_TRUE(is_attached()) << app().problem();
    press("t");
    draw_until([&] { return session().model().objects.size() == 3; });
    settle();
    EXPECT_TRUE(is_attached());
    press("space");
    draw_until([&] { return session().time() > 1.0; });
    settle();
    EXPECT_GT(center_height(0), 0.55);
    EXPECT_LT(center_height(1), 0.3) << "the other has fallen";
    EXPECT_TRUE(app().problem().empty()) << app().problem();
}

TEST_F(AttachingWindowHeavy, EscapeAndErrorsEndIt) {
    open(two_cubes());
    press("space");
    press("Tab");
    press("a");
    EXPECT_TRUE(session().attach_tool().is_active());
    press("Escape");
    EXPECT_FALSE(session().attach_tool().is_active());
    press("a");
    click(300, 260);
    click(340, 240);
    draw(2);
    EXPECT_NE(app().problem().find("another object"), std::string::npos) << app().problem();
    EXPECT_TRUE(session().attachments().empty());
}

// Of an attachment of the scene, which stays broken when the scene is edited.
TEST_F(AttachingWindowHeavy, ThePanelDetaches) {
    open(two_cubes() +
         "[[attachment]]\n"
         "object = 'large'\n"
         "point = [0, 0.7, 0.5]\n");
    press("space");
    settle();
    ASSERT_TRUE(is_attached());
    EXPECT_FALSE(session().attachments()[0].is_broken);
    click(430, 187);  // opens the attachments
    draw(4);
    click(600, 234);
    draw(2);
    settle();
    EXPECT_TRUE(session().attachments()[0].is_broken);
    act({"mousemove", "200", "200"});
    press("t");
    draw_until([&] { return session().model().objects.size() == 3; });
    settle();
    EXPECT_TRUE(session().attachments()[0].is_broken);
    press("r");
    draw_until([&] { return !session().attachments()[0].is_broken; });
}

TEST_F(AttachingWindowHeavy, WhatIsAttachedIsSaved) {
    open(two_cubes());
    press("space");
    press("Tab");
    press("a");
    click(320, 240);
    click(320, 20);
    ASSERT_TRUE(is_attached()) << app().problem();
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(path(""));
    press("ctrl+s");
    std::filesystem::current_path(before);
    ASSERT_EQ(app().notice(), "saved scene-1.toml");
    const Scene scene = load_scene(path("scene-1.toml"));
    ASSERT_EQ(scene.attachments.size(), 1u);
    EXPECT_EQ(scene.attachments[0].object, "large");
    EXPECT_NEAR(std::get<AttachedPoint>(scene.attachments[0].where).at.z, 0.5, 0.02) << "on its front";
}

}  // namespace
}  // namespace gelatin::test
