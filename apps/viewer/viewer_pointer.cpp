// ViewerApp: keys and mouse.
#include <GLFW/glfw3.h>

#include <cmath>
#include <utility>

#include "shortcuts.h"
#include "viewer_app.h"

namespace gelatin::viewer {
namespace {

constexpr float kHandNotch = 1.05f;  // a notch of the wheel multiplies the distance by this

}  // namespace

void ViewerApp::handle(const Event& event) {
    if (const auto* key = std::get_if<KeyPress>(&event)) {
        if (shows_start_screen() && start_screen_.take(*key)) return;
        if (const std::optional<Command> command = find_command(*key)) obey(*command);
    } else if (const auto* button = std::get_if<ButtonChange>(&event)) {
        handle(*button);
    } else if (const auto* move = std::get_if<PointerMove>(&event)) {
        handle(*move);
    } else if (const auto* wheel = std::get_if<WheelTurn>(&event)) {
        handle(*wheel);
    } else if (const auto* drop = std::get_if<FileDrop>(&event)) {
        if (!drop->files.empty()) open(drop->files);
    }
}

// A drag that begins at a mark moves what is held there. One that begins on a body pulls it. One beside the
// bodies rotates the view. Which of these it is is known only when the simulation can be queried.
void ViewerApp::handle(const ButtonChange& button) {
    pointer_ = button.place;
    if (button.is_down && !dragging_) {
        const bool is_left = button.button == GLFW_MOUSE_BUTTON_LEFT;
        if (is_left && click_to_attach(button)) return;
        if (is_left) take_handle(button.with_control);
        dragging_ = button.button;
        if (!session_ || !is_left || handle_drag_) return;
        session_->reach(camera_.ray(button.place));
        is_hand_asked_ = true;
        motion_since_asked_ = glm::vec2(0.0f);
    } else if (!button.is_down && dragging_ == button.button) {
        dragging_.reset();
        if (std::exchange(handle_drag_, {})) return;
        if (button.button == GLFW_MOUSE_BUTTON_LEFT && !is_hand_asked_) let_go();
    }
}

void ViewerApp::handle(const PointerMove& move) {
    const glm::vec2 motion = move.place - std::exchange(pointer_, move.place);
    if (!dragging_ || hand_depth_) return;
    if (handle_drag_) {
        handle_drag_->move_pointer(camera_, move.place);
        return session_->drag(handle_drag_->held(), handle_drag_->target());
    }
    if (*dragging_ != GLFW_MOUSE_BUTTON_LEFT) {
        camera_.pan(motion);
    } else if (is_hand_asked_) {
        motion_since_asked_ += motion;
    } else {
        camera_.orbit(motion);
    }
}

// While something is held, the wheel moves it away or nearer.
void ViewerApp::handle(const WheelTurn& wheel) {
    if (handle_drag_) {
        handle_drag_->scroll(camera_, wheel.notches);
        session_->drag(handle_drag_->held(), handle_drag_->target());
    } else if (hand_depth_) {
        *hand_depth_ *= std::pow(kHandNotch, wheel.notches);
    } else {
        camera_.zoom(wheel.notches, wheel.place);
    }
}

void ViewerApp::let_go() {
    hand_depth_.reset();
    if (session_) session_->let_go();
}

void ViewerApp::follow_hand() {
    if (is_hand_asked_ && session_ && session_->hand() != Session::Hand::reaching) {
        is_hand_asked_ = false;
        if (session_->hand() == Session::Hand::free) {
            camera_.orbit(motion_since_asked_);
        } else if (dragging_) {
            hand_depth_ = camera_.depth_of(session_->held_point());
        } else {
            let_go();
        }
    }
    if (hand_depth_ && session_) session_->move_hand(camera_.at_depth(pointer_, *hand_depth_));
}

}  // namespace gelatin::viewer
