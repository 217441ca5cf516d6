#include "viewer/shortcuts.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace gelatin::viewer {
namespace {

TEST(Shortcuts, EachKeyMeansOneThing) {
    std::set<std::pair<int, Shortcut::With>> keys;
    std::set<Command> commands;
    for (const Shortcut& shortcut : shortcuts()) {
        EXPECT_TRUE(keys.insert({shortcut.key, shortcut.with}).second) << shortcut.keys;
        EXPECT_TRUE(commands.insert(shortcut.command).second) << shortcut.keys;
    }
}

TEST(Shortcuts, AreFoundByTheirKeys) {
    EXPECT_EQ(find_command({.key = GLFW_KEY_SPACE}), Command::toggle_play);
    EXPECT_EQ(find_command({.key = GLFW_KEY_Q, .with_control = true}), Command::quit);
    EXPECT_EQ(find_command({.key = GLFW_KEY_Q}), std::nullopt);
    EXPECT_EQ(find_command({.key = GLFW_KEY_SPACE, .with_control = true}), std::nullopt);
    EXPECT_EQ(find_command({.key = GLFW_KEY_F12, .with_shift = true}), Command::screenshot_of_window);
    EXPECT_EQ(find_command({.key = GLFW_KEY_EQUAL, .with_shift = true}), Command::faster);
    EXPECT_EQ(find_command({.key = GLFW_KEY_KP_SUBTRACT}), Command::slower);
}

TEST(Shortcuts, AKeyHeldDownMakesStepsAlone) {
    EXPECT_EQ(find_command({.key = GLFW_KEY_PERIOD, .is_repeat = true}), Command::step);
    EXPECT_EQ(find_command({.key = GLFW_KEY_SPACE, .is_repeat = true}), std::nullopt);
}

}  // namespace
}  // namespace gelatin::viewer
