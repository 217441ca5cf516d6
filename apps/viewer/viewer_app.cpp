#include "viewer_app.h"

#include <fmt/core.h>

#include <glm/common.hpp>
#include <utility>

#include "core/log.h"
#include "gelatin/error.h"
#include "picture/surroundings.h"

namespace gelatin::viewer {
namespace {

constexpr double kNoticeTime = 4.0;  // [s]
constexpr double kLong = 3.0;        // longest wait without an event [s]
constexpr double kIdle = 0.1;        // between pictures when nothing moves [s]

}  // namespace

ViewerApp::ViewerApp(Window& window, const ViewerOptions& options) : window_(window), options_(options) {
    if (!options_.input.files.empty()) open(options_.input.files);
}

ViewerApp::~ViewerApp() {
    if (film_) end_film();
}

void ViewerApp::open(const std::vector<std::filesystem::path>& files) {
    if (files != options_.input.files) options_.input = {files};  // options were meant for others
    problem_.clear();
    shows_start_screen_ = false;
    opened_at_ = window_.now();
    loader_.open(options_.input);
}

void ViewerApp::draw_frame() {
    window_.begin_frame(patience());
    panels_.scale = window_.scale();
    panels_.camera = camera_.camera();
    const double now = window_.now(), elapsed = now - std::exchange(last_frame_, now);
    if (elapsed > 0.0) panels_.picture_rate += 0.1 * (1.0 / elapsed - panels_.picture_rate);
    for (const Event& event : window_.take_events()) handle(event);
    take_loaded_scene();
    if (shader_watch_.has_changed(now)) reload_shaders();
    const bool is_new = session_ && session_->update(now);
    if (session_ && std::exchange(told_problem_, session_->problem()) != session_->problem())
        if (!session_->problem().empty()) fail(session_->problem() + "\n\nR goes back to the start.");
    follow_hand();
    follow_attach_tool();
    draw_picture(is_new);
    const Requests requests = draw_panels();
    window_.draw_panels();
    save_pictures();
    window_.present();
    update_title();
    obey(requests);
}

// Panels need a picture or two to show what happened.
double ViewerApp::patience() const {
    return loader_.is_busy() || (session_ && session_->is_busy()) ? 0.0 : kIdle;
}

float ViewerApp::aspect() const {
    const glm::ivec2 size = glm::max(window_.pixels(), glm::ivec2(1));
    return static_cast<float>(size.x) / static_cast<float>(size.y);
}

void ViewerApp::take_loaded_scene() {
    // A scene that continues takes over the state when the running batch is done.
    if (session_ && session_->is_computing()) return;
    try {
        if (auto result = loader_.take()) show_scene(std::move(*result));
    } catch (const Error& error) {
        fail(error.what());
        if (!session_) return;
        panels_.edited = session_->own_scene();  // the request is impossible
        if (!hand_depth_) session_->let_go();
    }
}

void ViewerApp::show_scene(SceneLoader::Result result) {
    const bool goes_on = result.purpose == SceneLoader::Purpose::go_on && session_;
    auto session = std::make_unique<Session>(std::move(result.loaded), options_.backend,
                                             goes_on ? session_.get() : nullptr);
    session->show(panels_.overlays);
    session_ = std::move(session);
    // The pull belonged to the old simulator.
    hand_depth_.reset();
    is_hand_asked_ = false;
    handle_drag_.reset();
    if (goes_on) return;
    start_screen_.remember(options_.input.files);
    panels_.edited = session_->scene();
    own_bodies_ = session_->scene().objects.size();
    const Shown shown(session_->simulator());
    surroundings_ = describe_surroundings(session_->simulator(), shown);
    camera_.set(shown.camera(aspect()), session_->scene().up);
    if (renderer_) renderer_->set_surroundings(surroundings_);
}

void ViewerApp::draw_picture(bool is_new) {
    const glm::ivec2 size = window_.pixels();
    if (!session_ || size.x == 0 || size.y == 0) return window_.show_picture(0);
    if (!renderer_) {
        make_renderer(size.x, size.y);
    } else if (renderer_->width() != size.x || renderer_->height() != size.y) {
        if (film_) end_film();
        renderer_->resize(size.x, size.y);
        drawn_camera_.reset();
    }
    const render::Camera camera = camera_.camera();
    if (is_new || drawn_camera_ != camera) {
        drawn_camera_ = camera;
        try {
            if (session_->view().node_count > 0) renderer_->draw(session_->view(), camera);
        } catch (const GlError& error) {
            fail(error.what());  // overlays compile their programs when they are first drawn
        }
        if (film_ && is_new) film_picture();
    }
    window_.show_picture(renderer_->framebuffer());
}

// On an error the previous one stays.
void ViewerApp::make_renderer(int width, int height) {
    render::RendererOptions options;
    options.width = width;
    options.height = height;
    options.quality = options_.quality;
    auto renderer = std::make_unique<render::Renderer>(options);
    renderer->set_surroundings(surroundings_);
    renderer_ = std::move(renderer);
    panels_.quality = renderer_->quality() == render::Quality::fast ? "fast" : "high";
    drawn_camera_.reset();
}

// Renderers and simulations compile programs when they are constructed, so new ones replace the old.
void ViewerApp::reload_shaders() {
    try {
        if (renderer_) make_renderer(renderer_->width(), renderer_->height());
        if (session_ && session_->simulator().uses_gl()) loader_.rebuild(panels_.edited);
        problem_.clear();
        notify("shaders read again");
    } catch (const GlError& error) {
        fail(error.what());
    }
}

Requests ViewerApp::draw_panels() {
    Requests requests;
    const float scale = window_.scale();
    if (session_ && !shows_start_screen()) {
        const std::vector<Marker> marked = markers();
        draw_markers(scale, marked, pointed(marked));
        draw_attach_tool();
        if (shows_panels_) draw_session_panel(*session_, panels_, requests);
    }
    // One panel in the middle at a time.
    if (!problem_.empty()) {
        if (!draw_problem(scale, problem_)) problem_.clear();
    } else if (shows_help_) {
        draw_help(scale, requests);
    } else if (shows_start_screen()) {
        start_screen_.draw(scale, session_ != nullptr, requests);
    }
    if (loader_.is_busy() && loader_.purpose() == SceneLoader::Purpose::show) {
        const double since = window_.now() - opened_at_;
        draw_notice(scale, fmt::format("opening {} ...{}", loader_.file().filename().string(),
                                       since < kLong ? "" : fmt::format(" {:.0f} s", since)));
    } else if (session_ && session_->attach_tool().is_active()) {
        draw_notice(scale, session_->attach_tool().hint());
    } else if (window_.now() < notice_until_) {
        draw_notice(scale, notice_);
    } else if (film_) {
        draw_notice(scale, "filming " + film_->file().string() + " (F9 ends it)");
    }
    return requests;
}

void ViewerApp::notify(const std::string& notice) {
    notice_ = notice;
    notice_until_ = window_.now() + kNoticeTime;
}

void ViewerApp::fail(const std::string& problem) {
    if (problem == problem_) return;
    log_error(problem.substr(0, problem.find('\n')));
    problem_ = problem;
}

void ViewerApp::update_title() {
    if (!session_) return window_.set_title("Gelatin");
    window_.set_title(fmt::format("{} ({}) - Gelatin", session_->scene().file.filename().string(),
                                  session_->is_playing() ? "playing" : "paused"));
}

}  // namespace gelatin::viewer
