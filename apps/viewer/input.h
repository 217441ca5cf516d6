#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <variant>
#include <vector>

namespace gelatin::viewer {

/// A key went down, or is held down and repeats.
struct KeyPress {
    int key = 0;  ///< GLFW's
    bool with_control = false, with_shift = false;
    bool is_repeat = false;
};

/// Positions of the pointer are in heights of the window from its centre, x to the right, y up.
struct ButtonChange {
    int button = 0;  ///< GLFW's
    bool is_down = false;
    bool with_control = false;
    glm::vec2 place{0.0f};
};

struct PointerMove {
    glm::vec2 place{0.0f};
};

struct WheelTurn {
    float notches = 0.0f;  ///< away from the user: > 0
    glm::vec2 place{0.0f};
};

struct FileDrop {
    std::vector<std::filesystem::path> files;
};

/// The user's events, one by one, so that none is lost when pictures are slow.
using Event = std::variant<KeyPress, ButtonChange, PointerMove, WheelTurn, FileDrop>;

}  // namespace gelatin::viewer
