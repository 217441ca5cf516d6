#pragma once

#include <optional>
#include <span>

#include "command.h"
#include "input.h"

namespace gelatin::viewer {

struct Shortcut {
    enum class With { nothing, control, shift };

    int key;    ///< GLFW's
    With with;  ///< what is held down too
    Command command;
    const char* keys;     ///< as the list of shortcuts shows them
    const char* meaning;  ///< what happens
};

/// All shortcuts, in the order of the list that F1 shows. The one table that keys are looked up in, too.
std::span<const Shortcut> shortcuts();

std::optional<Command> find_command(const KeyPress& press);

/// What the mouse does, for the same list: {gesture, meaning}.
struct Gesture {
    const char* gesture;
    const char* meaning;
};
std::span<const Gesture> gestures();

}  // namespace gelatin::viewer
