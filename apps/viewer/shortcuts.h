#pragma once

#include <optional>
#include <span>

#include "command.h"
#include "input.h"

namespace gelatin::viewer {

struct Shortcut {
    enum class With { nothing, control, shift };

    int key;    ///< GLFW's
    With with;  ///< the modifier that is held down
    Command command;
    const char* keys;     ///< as shown in the list of shortcuts
    const char* meaning;  ///< its effect
};

/// All shortcuts, in the order of the list that F1 shows. Keys are looked up in the same table.
std::span<const Shortcut> shortcuts();

std::optional<Command> find_command(const KeyPress& press);

/// The mouse gestures, for the same list: {gesture, meaning}.
struct Gesture {
    const char* gesture;
    const char* meaning;
};
std::span<const Gesture> gestures();

}  // namespace gelatin::viewer
