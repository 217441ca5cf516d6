#include "shortcuts.h"

#include <GLFW/glfw3.h>

#include <array>

namespace gelatin::viewer {
namespace {

using With = Shortcut::With;

// A key that is held down repeats steps, but does not alternate between play and pause.
bool may_repeat(Command command) {
    return command == Command::step || command == Command::step_frame;
}

}  // namespace

std::span<const Shortcut> shortcuts() {
    static constexpr std::array kShortcuts{
        Shortcut{GLFW_KEY_SPACE, With::nothing, Command::toggle_play, "Space", "play, pause"},
        Shortcut{GLFW_KEY_PERIOD, With::nothing, Command::step, ".", "one step"},
        Shortcut{GLFW_KEY_RIGHT, With::nothing, Command::step_frame, "Right", "one frame"},
        Shortcut{GLFW_KEY_R, With::nothing, Command::reset, "R", "back to the start"},
        Shortcut{GLFW_KEY_F5, With::nothing, Command::reload, "F5", "read the scene file again"},
        Shortcut{GLFW_KEY_T, With::nothing, Command::throw_body, "T",
                 "throw a copy of a body to the pointer"},
        Shortcut{GLFW_KEY_P, With::nothing, Command::pin, "P",
                 "pin the held body; remove the pin at the pointer"},
        Shortcut{GLFW_KEY_A, With::nothing, Command::attach, "A",
                 "attach a body by two clicks; Ctrl: by a rope"},
        Shortcut{GLFW_KEY_MINUS, With::nothing, Command::slower, "-", "half the speed"},
        Shortcut{GLFW_KEY_EQUAL, With::nothing, Command::faster, "+", "twice the speed, up to real time"},
        Shortcut{GLFW_KEY_F, With::nothing, Command::frame_all, "F", "show all bodies"},
        Shortcut{GLFW_KEY_1, With::nothing, Command::toggle_springs, "1", "springs coloured by strain"},
        Shortcut{GLFW_KEY_2, With::nothing, Command::toggle_faces, "2", "faces that touch"},
        Shortcut{GLFW_KEY_3, With::nothing, Command::toggle_boxes, "3", "boxes of the hierarchy"},
        Shortcut{GLFW_KEY_4, With::nothing, Command::toggle_cut, "4", "cut the bodies open"},
        Shortcut{GLFW_KEY_5, With::nothing, Command::toggle_stretch, "5", "stretch in colours"},
        Shortcut{GLFW_KEY_6, With::nothing, Command::toggle_stress, "6", "stress in colours"},
        Shortcut{GLFW_KEY_7, With::nothing, Command::toggle_speed, "7", "speed in colours"},
        Shortcut{GLFW_KEY_8, With::nothing, Command::toggle_arrows, "8", "velocities as arrows"},
        Shortcut{GLFW_KEY_9, With::nothing, Command::toggle_wireframe, "9", "edges of the surfaces"},
        Shortcut{GLFW_KEY_0, With::nothing, Command::toggle_objects, "0", "objects by colour and name"},
        Shortcut{GLFW_KEY_C, With::nothing, Command::toggle_contact_forces, "C", "contact forces as arrows"},
        Shortcut{GLFW_KEY_C, With::shift, Command::toggle_pressure, "Shift+C",
                 "pressure of contacts in colours"},
        Shortcut{GLFW_KEY_A, With::shift, Command::toggle_attachments, "Shift+A",
                 "attachments: points, lines and axes"},
        Shortcut{GLFW_KEY_B, With::nothing, Command::toggle_bones, "B",
                 "bones of skeletons, and the nodes they carry"},
        Shortcut{GLFW_KEY_G, With::nothing, Command::toggle_start_screen, "G", "choose another scene"},
        Shortcut{GLFW_KEY_TAB, With::nothing, Command::toggle_panels, "Tab", "hide or show the panels"},
        Shortcut{GLFW_KEY_F12, With::nothing, Command::screenshot, "F12", "save the picture as PNG"},
        Shortcut{GLFW_KEY_F12, With::shift, Command::screenshot_of_window, "Shift+F12",
                 "the same with the panels"},
        Shortcut{GLFW_KEY_F9, With::nothing, Command::toggle_film, "F9", "start a film, stop it"},
        Shortcut{GLFW_KEY_S, With::control, Command::save_scene, "Ctrl+S", "save the scene with its changes"},
        Shortcut{GLFW_KEY_F1, With::nothing, Command::toggle_help, "F1", "this list"},
        Shortcut{GLFW_KEY_ESCAPE, With::nothing, Command::dismiss, "Esc",
                 "close a message, this list, the choice of scenes"},
        Shortcut{GLFW_KEY_Q, With::control, Command::quit, "Ctrl+Q", "quit"},
    };
    return kShortcuts;
}

std::optional<Command> find_command(const KeyPress& press) {
    int key = press.key;
    if (key == GLFW_KEY_KP_ADD) key = GLFW_KEY_EQUAL;
    if (key == GLFW_KEY_KP_SUBTRACT) key = GLFW_KEY_MINUS;
    // '+' needs Shift on most keyboards.
    const bool with_shift = press.with_shift && key != GLFW_KEY_EQUAL;
    const With with = press.with_control ? With::control : with_shift ? With::shift : With::nothing;
    for (const Shortcut& shortcut : shortcuts()) {
        if (shortcut.key != key || shortcut.with != with) continue;
        if (press.is_repeat && !may_repeat(shortcut.command)) return {};
        return shortcut.command;
    }
    return {};
}

std::span<const Gesture> gestures() {
    static constexpr std::array kGestures{
        Gesture{"drag a body", "pull at it; the wheel: away or nearer"},
        Gesture{"drag a pin or handle", "move it; the wheel: away or nearer"},
        Gesture{"Ctrl+drag it", "rotate it; the wheel: about the line of sight"},
        Gesture{"drag beside the bodies", "rotate the view"},
        Gesture{"right or middle drag", "move the view"},
        Gesture{"wheel", "zoom"},
    };
    return kGestures;
}

}  // namespace gelatin::viewer
