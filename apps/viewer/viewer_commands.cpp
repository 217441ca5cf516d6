// ViewerApp: the commands of keys and panels, and the files that they write.
#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "dragged_scene.h"
#include "gelatin/error.h"
#include "model/scene/scene_writer.h"
#include "overlay_choices.h"
#include "projectile.h"
#include "render/frame_grabber.h"
#include "render/image.h"
#include "viewer_app.h"

namespace gelatin::viewer {
namespace {

constexpr double kLeastSpeed = 1.0 / 64;  // of real time

render::Bounds bounds_of_bodies(const RenderView& view) {
    return {{view.box_min[0], view.box_min[1], view.box_min[2]},
            {view.box_max[0], view.box_max[1], view.box_max[2]}};
}

// The first of NAME-1.png, NAME-2.png, ... that does not exist yet.
std::filesystem::path free_name(const std::string& stem, const char* ending) {
    for (int i = 1;; ++i) {
        std::filesystem::path file = fmt::format("{}-{}{}", stem, i, ending);
        if (!std::filesystem::exists(file)) return file;
    }
}

}  // namespace

void ViewerApp::obey(Command command) {
    if (command == Command::toggle_help) {
        shows_help_ = !shows_help_;
    } else if (command == Command::dismiss) {
        if (session_) session_->attach_tool().cancel();
        if (problem_.empty() && !std::exchange(shows_help_, false)) shows_start_screen_ = false;
        problem_.clear();
    } else if (command == Command::toggle_start_screen) {
        shows_start_screen_ = !shows_start_screen_;
    } else if (command == Command::toggle_panels) {
        shows_panels_ = !shows_panels_;
    } else if (command == Command::quit) {
        window_.ask_to_close();
    } else if (command == Command::reload && !options_.input.files.empty()) {
        open(options_.input.files);
    } else if (command == Command::screenshot_of_window) {
        wants_window_picture_ = true;
    }
    if (!session_) return;
    if (const auto overlays = toggled(panels_.overlays, command, session_->view(), camera_.camera()))
        return show_overlays(*overlays);
    switch (command) {
        case Command::toggle_play:
            return session_->play(!session_->is_playing());
        case Command::step:
            session_->play(false);
            return session_->make_steps(1);
        case Command::step_frame:
            session_->play(false);
            return session_->make_steps(session_->simulator().substeps());
        case Command::reset:
            problem_.clear();
            return session_->reset();
        case Command::throw_body:
            return throw_body();
        case Command::pin:
            return pin();
        case Command::attach:
            return begin_to_attach();
        case Command::slower:
            return session_->set_speed(std::max(0.5 * session_->pace().speed(), kLeastSpeed));
        case Command::faster:
            return session_->set_speed(std::min(2.0 * session_->pace().speed(), 1.0));
        case Command::frame_all:
            return camera_.frame(bounds_of_bodies(session_->view()), aspect());
        case Command::save_scene:
            return save_scene();
        case Command::toggle_film:
            return toggle_film();
        case Command::screenshot:
            wants_picture_ = true;
            return;
        default:
            return;
    }
}

void ViewerApp::obey(const Requests& requests) {
    for (const Command command : requests.commands) obey(command);
    if (requests.speed && session_) session_->set_speed(*requests.speed);
    if (requests.recorded && session_) session_->show_recorded(*requests.recorded);
    if (requests.overlays) show_overlays(*requests.overlays);
    if (requests.shows_markers) panels_.shows_markers = *requests.shows_markers;
    if (session_) {
        for (const std::size_t attachment : requests.detached) session_->detach(attachment);
        for (const auto& [attachment, motor] : requests.motors) session_->set_motor(attachment, motor);
        for (const auto& [cavity, gas] : requests.gas) session_->set_cavity(cavity, gas);
    }
    if (!requests.opened.empty()) open(requests.opened);
    if (requests.edited) {
        panels_.edited = *requests.edited;
        loader_.rebuild(panels_.edited);
    }
}

// Cycles through the scene's own bodies. While one is being built, no other can be: it would need that one's
// model.
void ViewerApp::throw_body() {
    if (loader_.is_busy()) return;
    Scene scene = panels_.edited;
    const std::size_t thrown = scene.objects.size() - own_bodies_;
    const render::Camera camera = camera_.camera();
    const double distance = static_cast<double>(glm::distance(camera.eye, camera.target));
    scene.objects.push_back(
        make_projectile(scene, session_->model(), thrown % own_bodies_, camera_.ray(pointer_), distance));
    panels_.edited = std::move(scene);
    loader_.rebuild(panels_.edited);
}

// Of the files that are written.
std::string ViewerApp::stem() const {
    return options_.input.files.front().stem().string();
}

// With the present camera, drags, attachments and gas.
void ViewerApp::save_scene() {
    if (loader_.is_busy()) return notify("the scene is still being built");
    const std::filesystem::path file = free_name(stem(), ".toml");
    Scene scene = dragged_scene(panels_.edited, session_->held_nodes());
    scene.attachments = session_->attachments_to_save();
    session_->save_gas(scene);
    const render::Camera camera = camera_.camera();
    scene.camera = CameraDescription{glm::dvec3(camera.eye), glm::dvec3(camera.target),
                                     static_cast<double>(camera.field_of_view)};
    try {
        gelatin::save_scene(file, scene);
        notify("saved " + file.string());
    } catch (const Error& error) {
        fail(error.what());
    }
}

void ViewerApp::show_overlays(const Overlays& overlays) {
    panels_.overlays = overlays;
    if (session_) session_->show(overlays);
}

void ViewerApp::toggle_film() {
    if (film_) return end_film();
    if (!renderer_) return;
    try {
        film_.emplace(free_name(stem(), ".mp4"), renderer_->width(), renderer_->height());
    } catch (const Error& error) {
        fail(error.what());
    }
}

void ViewerApp::film_picture() {
    try {
        film_->add(renderer_->framebuffer(), session_->time(), session_->pace().speed());
    } catch (const Error& error) {
        film_.reset();
        fail(error.what());
    }
}

void ViewerApp::end_film() {
    try {
        film_->finish();
        notify("saved " + film_->file().string());
    } catch (const Error& error) {
        fail(error.what());
    }
    film_.reset();
}

void ViewerApp::save_pictures() {
    if (std::exchange(wants_picture_, false) && renderer_)
        save_picture(renderer_->framebuffer(), renderer_->width(), renderer_->height());
    if (std::exchange(wants_window_picture_, false)) save_picture(0, window_.pixels().x, window_.pixels().y);
}

void ViewerApp::save_picture(unsigned framebuffer, int width, int height) {
    const std::filesystem::path file = free_name(session_ ? stem() : "gelatin", ".png");
    try {
        render::FrameGrabber grabber(width, height);
        grabber.grab(framebuffer);
        if (const auto picture = grabber.flush()) render::write_png(file, *picture);
        notify("saved " + file.string());
    } catch (const Error& error) {
        fail(error.what());
    }
}

}  // namespace gelatin::viewer
