#include "viewer_app.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "common/surroundings.h"
#include "core/log.h"
#include "gelatin/error.h"
#include "gl/context.h"
#include "model/scene_writer.h"
#include "projectile.h"
#include "render/frame_grabber.h"
#include "render/image.h"
#include "shortcuts.h"

namespace gelatin::viewer {
namespace {

constexpr double kNoticeTime = 4.0;       // [s]
constexpr double kIdle = 0.1;             // between pictures when nothing moves [s]
constexpr double kLeastSpeed = 1.0 / 64;  // of real time
constexpr int kUsualBoxLevels = 2;
constexpr float kHandNotch = 1.05f;  // a notch of the wheel takes what is held so much farther away

render::Quality choose_quality(render::Quality quality) {
    if (quality != render::Quality::automatic) return quality;
    return gl::Context::current().device().is_software ? render::Quality::fast : render::Quality::high;
}

render::Bounds bounds_of_bodies(const RenderView& view) {
    return {{view.box_min[0], view.box_min[1], view.box_min[2]},
            {view.box_max[0], view.box_max[1], view.box_max[2]}};
}

// The first of NAME-1.png, NAME-2.png, ... that is not there yet.
std::filesystem::path free_name(const std::string& stem, const char* ending) {
    for (int i = 1;; ++i) {
        std::filesystem::path file = fmt::format("{}-{}{}", stem, i, ending);
        if (!std::filesystem::exists(file)) return file;
    }
}

}  // namespace

ViewerApp::ViewerApp(Window& window, const ViewerOptions& options)
    : window_(window), options_(options), samples_(sample_scenes()) {
    options_.quality = choose_quality(options.quality);
    panels_.quality = options_.quality == render::Quality::fast ? "fast" : "high";
    if (!options_.scene.empty()) open(options_.scene);
}

ViewerApp::~ViewerApp() {
    if (film_) end_film();
}

void ViewerApp::open(const std::filesystem::path& file) {
    if (file != options_.scene) options_.overrides.clear();  // meant for another
    options_.scene = file;
    problem_.clear();
    loader_.open(file, options_.overrides);
}

void ViewerApp::draw_frame() {
    window_.begin_frame(patience());
    panels_.scale = window_.scale();
    const double now = window_.now(), elapsed = now - std::exchange(last_frame_, now);
    if (elapsed > 0.0) panels_.picture_rate += 0.1 * (1.0 / elapsed - panels_.picture_rate);
    for (const Event& event : window_.take_events()) handle(event);
    take_loaded_scene();
    if (shader_watch_.has_changed(now)) reload_shaders();
    const bool is_new = session_ && session_->update(now);
    if (session_ && std::exchange(told_problem_, session_->problem()) != session_->problem())
        if (!session_->problem().empty()) fail(session_->problem() + "\n\nR goes back to the start.");
    follow_hand();
    draw_picture(is_new);
    const Requests requests = draw_panels();
    window_.draw_panels();
    save_pictures();
    window_.present();
    update_title();
    obey(requests);
}

// Panels take a picture or two to follow what happened.
double ViewerApp::patience() const {
    const bool is_busy =
        loader_.is_busy() || (session_ && (session_->is_playing() || session_->is_computing()));
    return is_busy ? 0.0 : kIdle;
}

float ViewerApp::aspect() const {
    const glm::ivec2 size = glm::max(window_.pixels(), glm::ivec2(1));
    return static_cast<float>(size.x) / static_cast<float>(size.y);
}

void ViewerApp::take_loaded_scene() {
    // A scene that goes on takes over what is under way once that is done.
    if (session_ && session_->is_computing()) return;
    try {
        if (auto result = loader_.take()) show_scene(std::move(*result));
    } catch (const Error& error) {
        fail(error.what());
        if (session_) panels_.edited = session_->scene();  // what was wished for cannot be
    }
}

void ViewerApp::show_scene(SceneLoader::Result result) {
    const bool goes_on = result.purpose == SceneLoader::Purpose::go_on && session_;
    auto session = std::make_unique<Session>(std::move(result.loaded), options_.backend,
                                             goes_on ? session_.get() : nullptr);
    session->show(panels_.overlays);
    session_ = std::move(session);
    // The hand was the old one's.
    hand_depth_.reset();
    is_hand_asked_ = false;
    if (goes_on) return;
    panels_.edited = session_->scene();
    own_bodies_ = session_->scene().objects.size();
    surroundings_ = describe_surroundings(session_->simulator());
    camera_.set(choose_camera(session_->scene(), surroundings_, aspect()));
    if (renderer_) renderer_->set_surroundings(surroundings_);
}

void ViewerApp::handle(const Event& event) {
    if (const auto* key = std::get_if<KeyPress>(&event)) {
        if (const std::optional<Command> command = find_command(*key)) obey(*command);
    } else if (const auto* button = std::get_if<ButtonChange>(&event)) {
        handle(*button);
    } else if (const auto* move = std::get_if<PointerMove>(&event)) {
        handle(*move);
    } else if (const auto* wheel = std::get_if<WheelTurn>(&event)) {
        handle(*wheel);
    } else if (const auto* drop = std::get_if<FileDrop>(&event)) {
        if (!drop->files.empty()) open(drop->files.front());
    }
}

// A drag that begins on a body is a hand's, one beside turns the view. Which it is shows once the simulation
// can be asked.
void ViewerApp::handle(const ButtonChange& button) {
    pointer_ = button.place;
    if (button.is_down && !dragging_) {
        dragging_ = button.button;
        if (!session_ || button.button != GLFW_MOUSE_BUTTON_LEFT) return;
        session_->reach(camera_.ray(button.place));
        is_hand_asked_ = true;
        way_since_asked_ = glm::vec2(0.0f);
    } else if (!button.is_down && dragging_ == button.button) {
        dragging_.reset();
        if (button.button == GLFW_MOUSE_BUTTON_LEFT && !is_hand_asked_) let_go();
    }
}

void ViewerApp::handle(const PointerMove& move) {
    const glm::vec2 way = move.place - std::exchange(pointer_, move.place);
    if (!dragging_ || hand_depth_) return;
    if (*dragging_ != GLFW_MOUSE_BUTTON_LEFT) {
        camera_.pan(way);
    } else if (is_hand_asked_) {
        way_since_asked_ += way;
    } else {
        camera_.orbit(way);
    }
}

// With a body in hand the wheel takes it away or brings it here.
void ViewerApp::handle(const WheelTurn& wheel) {
    if (hand_depth_) {
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
            camera_.orbit(way_since_asked_);
        } else if (dragging_) {
            hand_depth_ = camera_.depth_of(session_->held_point());
        } else {
            let_go();
        }
    }
    if (hand_depth_ && session_) session_->move_hand(camera_.at_depth(pointer_, *hand_depth_));
}

void ViewerApp::obey(Command command) {
    if (command == Command::toggle_help) {
        shows_help_ = !shows_help_;
    } else if (command == Command::toggle_panels) {
        shows_panels_ = !shows_panels_;
    } else if (command == Command::quit) {
        window_.ask_to_close();
    } else if (command == Command::reload && !options_.scene.empty()) {
        open(options_.scene);
    } else if (command == Command::screenshot_of_window) {
        wants_window_picture_ = true;
    }
    if (!session_) return;
    Overlays overlays = panels_.overlays;
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
        case Command::slower:
            return session_->set_speed(std::max(0.5 * session_->pace().speed(), kLeastSpeed));
        case Command::faster:
            return session_->set_speed(std::min(2.0 * session_->pace().speed(), 1.0));
        case Command::frame_all:
            return camera_.frame(bounds_of_bodies(session_->view()), aspect());
        case Command::toggle_strain:
            overlays.full_strain = overlays.full_strain ? std::nullopt : std::optional(kUsualStrain);
            return show_overlays(overlays);
        case Command::toggle_faces:
            overlays.faces = !overlays.faces;
            return show_overlays(overlays);
        case Command::toggle_boxes:
            overlays.box_levels = overlays.box_levels ? std::nullopt : std::optional(kUsualBoxLevels);
            return show_overlays(overlays);
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
    if (requests.overlays) show_overlays(*requests.overlays);
    if (requests.opened) open(*requests.opened);
    if (requests.edited) {
        panels_.edited = *requests.edited;
        loader_.rebuild(panels_.edited);
    }
}

// The scene's own bodies in turns. While one is being made, no other is: it would need that one's model.
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

// Seen from where the camera is.
void ViewerApp::save_scene() {
    const std::filesystem::path file = free_name(options_.scene.stem().string(), ".toml");
    Scene scene = panels_.edited;
    const render::Camera camera = camera_.camera();
    scene.camera = CameraDescription{glm::dvec3(camera.eye), glm::dvec3(camera.target),
                                     static_cast<double>(camera.field_of_view)};
    try {
        gelatin::save_scene(file, scene);
        tell("saved " + file.string());
    } catch (const Error& error) {
        fail(error.what());
    }
}

void ViewerApp::show_overlays(const Overlays& overlays) {
    panels_.overlays = overlays;
    if (session_) session_->show(overlays);
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
            fail(error.what());  // overlays make their programs when they are first drawn
        }
        if (film_ && is_new) film_picture();
    }
    window_.show_picture(renderer_->framebuffer());
}

// Where something is wrong the one before stays.
void ViewerApp::make_renderer(int width, int height) {
    render::RendererOptions options;
    options.width = width;
    options.height = height;
    options.quality = options_.quality;
    auto renderer = std::make_unique<render::Renderer>(options);
    renderer->set_surroundings(surroundings_);
    renderer_ = std::move(renderer);
    drawn_camera_.reset();
}

// Programs are made where a renderer and a simulation are: new ones take the place of the old.
void ViewerApp::reload_shaders() {
    try {
        if (renderer_) make_renderer(renderer_->width(), renderer_->height());
        if (session_ && session_->simulator().uses_gl()) loader_.rebuild(panels_.edited);
        problem_.clear();
        tell("shaders read again");
    } catch (const GlError& error) {
        fail(error.what());
    }
}

void ViewerApp::toggle_film() {
    if (film_) return end_film();
    if (!renderer_) return;
    try {
        film_.emplace(free_name(options_.scene.stem().string(), ".mp4"), renderer_->width(),
                      renderer_->height());
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
        tell("saved " + film_->file().string());
    } catch (const Error& error) {
        fail(error.what());
    }
    film_.reset();
}

Requests ViewerApp::draw_panels() {
    Requests requests;
    const float scale = window_.scale();
    if (session_ && shows_panels_) draw_session_panel(*session_, panels_, requests);
    if (!session_ && !loader_.is_busy()) draw_start_screen(scale, samples_, requests);
    if (shows_help_) draw_help(scale, requests);
    if (!problem_.empty() && !draw_problem(scale, problem_)) problem_.clear();
    if (loader_.is_busy() && loader_.purpose() == SceneLoader::Purpose::show) {
        draw_notice(scale, fmt::format("opening {} ...", loader_.file().filename().string()));
    } else if (window_.now() < notice_until_) {
        draw_notice(scale, notice_);
    } else if (film_) {
        draw_notice(scale, "filming " + film_->file().string() + " (F9 ends it)");
    }
    return requests;
}

void ViewerApp::save_pictures() {
    if (std::exchange(wants_picture_, false) && renderer_)
        save_picture(renderer_->framebuffer(), renderer_->width(), renderer_->height());
    if (std::exchange(wants_window_picture_, false)) save_picture(0, window_.pixels().x, window_.pixels().y);
}

void ViewerApp::save_picture(unsigned framebuffer, int width, int height) {
    const std::filesystem::path file =
        free_name(session_ ? options_.scene.stem().string() : "gelatin", ".png");
    try {
        render::FrameGrabber grabber(width, height);
        grabber.grab(framebuffer);
        if (const auto picture = grabber.flush()) render::write_png(file, *picture);
        tell("saved " + file.string());
    } catch (const Error& error) {
        fail(error.what());
    }
}

void ViewerApp::tell(const std::string& notice) {
    notice_ = notice;
    notice_until_ = window_.now() + kNoticeTime;
}

void ViewerApp::fail(const std::string& problem) {
    if (problem == problem_) return;
    spdlog::error("{}", problem.substr(0, problem.find('\n')));
    problem_ = problem;
}

void ViewerApp::update_title() {
    if (!session_) return window_.set_title("Gelatin");
    window_.set_title(fmt::format("{} ({}) - Gelatin", session_->scene().file.filename().string(),
                                  session_->is_playing() ? "playing" : "paused"));
}

}  // namespace gelatin::viewer
