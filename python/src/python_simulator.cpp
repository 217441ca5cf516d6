#include "python_simulator.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "gelatin/error.h"
#include "gelatin/recording.h"
#include "model/scene/value_text.h"
#include "scene_conversion.h"
#include "sim/simulator_internals.h"

namespace gelatin::python {
namespace {

using Clock = std::chrono::steady_clock;

// How long a signal may have to wait, besides the call that runs. To ask needs the interpreter's lock, for
// which other threads may let us wait as long as a hundred short steps.
constexpr auto kSignalInterval = std::chrono::milliseconds(50);

SimulatorOptions options_of(const std::string& backend, std::optional<int> gl_device, bool gl_debug) {
    SimulatorOptions options;
    options.gl_device = gl_device;
    options.gl_debug = gl_debug;
    if (backend == "auto") return options;
    if (backend != "gl" && backend != "cpu")
        throw InvalidInput({{}, 0, "backend", text_of(backend), "must be \"auto\", \"gl\" or \"cpu\""});
    options.backend = backend == "gl" ? Backend::gl : Backend::cpu;
    return options;
}

// Meshes are made in it, for seconds.
std::unique_ptr<Simulator> make_simulator(nb::handle source, const SimulatorOptions& options) {
    const Scene scene = scene_of(source);
    const MessagesAtEnd messages;
    const nb::gil_scoped_release released;
    return std::make_unique<Simulator>(scene, options);
}

}  // namespace

std::unique_lock<std::mutex> Turn::take() const {
    std::unique_lock<std::mutex> lock(*mutex_, std::try_to_lock);
    if (!lock.owns_lock()) throw std::runtime_error("the simulator is in use by another thread");
    return lock;
}

void make_in_pieces(std::int64_t count, const std::function<void(std::int64_t)>& make) {
    const nb::gil_scoped_release released;
    std::int64_t piece = 1;
    while (count > 0) {
        const std::int64_t now = std::min(piece, count);
        const Clock::time_point start = Clock::now();
        make(now);
        count -= now;
        const auto taken = Clock::now() - start;
        if (taken < kSignalInterval / 2) piece *= 2;
        if (taken > kSignalInterval) piece = std::max<std::int64_t>(1, piece / 2);
        const nb::gil_scoped_acquire acquired;
        tell_messages();
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
    }
}

PythonSimulator::PythonSimulator(nb::handle scene, const std::string& backend, std::optional<int> gl_device,
                                 bool gl_debug)
    : own_(make_simulator(scene, options_of(backend, gl_device, gl_debug))), simulator_(own_.get()) {
    if (simulator_->uses_gl()) gl_thread_ = std::this_thread::get_id();
}

PythonSimulator::PythonSimulator(const std::string& recording)
    : own_(std::make_unique<Simulator>(std::make_shared<const Recording>(recording))),
      simulator_(own_.get()) {}

PythonSimulator::PythonSimulator(Simulator& simulator, const Turn& turn, nb::object owner)
    : simulator_(&simulator), owner_(std::move(owner)), turn_(turn) {}

PythonSimulator::~PythonSimulator() {
    if (!gl_thread_) return;
    try {
        make_current();  // its OpenGL objects are in its own context
    } catch (const std::exception&) {
        // On another thread it stays there until the process ends.
        static_cast<void>(new std::optional<Painter>(std::move(painter_)));
        static_cast<void>(own_.release());
        return;
    }
    painter_.reset();
}

void PythonSimulator::make_current() {
    if (std::this_thread::get_id() != gl_thread_)
        throw std::runtime_error("what uses OpenGL of a simulator belongs to the thread that used it first");
    SimulatorInternals::make_current(*simulator_);
}

bool PythonSimulator::can_paint(const PictureOptions& options) const {
    if (!painter_) return false;
    const PictureOptions& made = painter_->options;
    // Without one the first picture chose a camera, which stays: bodies move, and not the picture's frame.
    return made.width == options.width && made.height == options.height && made.quality == options.quality &&
           made.camera.has_value() == options.camera.has_value();
}

Picture PythonSimulator::paint(const PictureOptions& options) {
    return use([&](Simulator& simulator) {
        const nb::gil_scoped_release released;
        if (!gl_thread_) {
            SimulatorInternals::need_context(simulator);
            gl_thread_ = std::this_thread::get_id();
        }
        make_current();
        if (!can_paint(options)) {
            painter_.reset();
            painter_.emplace(Painter{PicturePainter(simulator, options), options});
        }
        painter_->painter.set_overlays(options.overlays);
        if (options.camera) painter_->painter.set_camera(*options.camera);
        return painter_->painter.paint();
    });
}

void PythonSimulator::step(std::int64_t count) {
    if (count < 0) throw InvalidInput({{}, 0, "count", std::to_string(count), "must be 0 or more"});
    use([&](Simulator& simulator) {
        make_in_pieces(count, [&](std::int64_t steps) {
            for (std::int64_t s = 0; s < steps; ++s) simulator.step();
        });
        const nb::gil_scoped_release released;
        if (simulator.uses_gl()) simulator.check();
    });
}

void PythonSimulator::advance(std::int64_t frames) {
    if (frames < 0) throw InvalidInput({{}, 0, "frames", std::to_string(frames), "must be 0 or more"});
    const bool is_played = simulator_->recording() != nullptr;  // where a step goes to the next frame
    step(is_played ? frames : frames * simulator_->substeps());
}

}  // namespace gelatin::python
