// ViewerApp: attaching by two clicks.
#include "viewer_app.h"

namespace gelatin::viewer {

void ViewerApp::begin_to_attach() {
    if (session_->recording() != nullptr) return notify("in a recording nothing can be attached");
    session_->attach_tool().begin();
    Overlays overlays = panels_.overlays;
    overlays.attachments = true;  // to show what will be made
    show_overlays(overlays);
}

bool ViewerApp::click_to_attach(const ButtonChange& button) {
    if (!session_ || !session_->attach_tool().is_active()) return false;
    session_->attach_tool().click(camera_.ray(button.place), button.with_control);
    return true;
}

// What was made, or why nothing was.
void ViewerApp::follow_attach_tool() {
    if (!session_) return;
    if (const std::string news = session_->take_news(); !news.empty()) notify(news);
    if (const std::string refusal = session_->take_refusal(); !refusal.empty()) fail(refusal);
}

void ViewerApp::draw_attach_tool() {
    const std::optional<glm::vec3>& point = session_->attach_tool().first_point();
    if (!point) return;
    if (const auto place = camera_.place_of(*point)) draw_first_point(window_.scale(), *place, pointer_);
}

}  // namespace gelatin::viewer
