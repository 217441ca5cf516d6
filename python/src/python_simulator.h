#pragma once

#include <nanobind/nanobind.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "gelatin/picture.h"
#include "gelatin/simulator.h"
#include "messages.h"

namespace gelatin::python {

namespace nb = nanobind;

/// What one thread of Python uses at a time: the interpreter's lock, which is released during steps, does not
/// see to that.
class Turn {
public:
    /// @throws std::runtime_error, Python's RuntimeError, if another thread has it
    std::unique_lock<std::mutex> take() const;

private:
    std::shared_ptr<std::mutex> mutex_ = std::make_shared<std::mutex>();
};

/// Calls `make(n)` with numbers that sum to `count`, without the interpreter's lock. Asks for signals twenty
/// times a second.
/// @throws nanobind's python_error for a signal (Ctrl-C), between two calls
void make_in_pieces(std::int64_t count, const std::function<void(std::int64_t)>& make);

/// A simulator for Python: every call of it goes through `use`. With OpenGL all calls must come from the
/// thread that made it.
class PythonSimulator {
public:
    PythonSimulator(nb::handle scene, const std::string& backend, std::optional<int> gl_device,
                    bool gl_debug);
    /// Plays a recording.
    explicit PythonSimulator(const std::string& recording);
    /// One of a batch. @param owner of the simulator; it must have a reference to this of its own
    PythonSimulator(Simulator& simulator, const Turn& turn, nb::object owner);
    PythonSimulator(const PythonSimulator&) = delete;
    PythonSimulator& operator=(const PythonSimulator&) = delete;
    ~PythonSimulator();

    /// Runs `work` with the simulator, its context being current. Messages are reported at the end.
    template <class Work>
    decltype(auto) use(const Work& work) {
        const MessagesAtEnd messages;
        const std::unique_lock<std::mutex> lock = turn_.take();
        if (simulator_->uses_gl()) make_current();
        return work(*simulator_);
    }

    /// Makes `count` steps, or frames. @throws Diverged; as make_in_pieces
    void step(std::int64_t count);
    void advance(std::int64_t frames);

    /// A picture of the present state. It makes an OpenGL context where there is none, and keeps what is
    /// compiled for the next picture of the same size and quality.
    Picture paint(const PictureOptions& options);

private:
    struct Painter {
        PicturePainter painter;
        PictureOptions options;
    };
    void make_current();
    bool can_paint(const PictureOptions& options) const;

    std::unique_ptr<Simulator> own_;  // null: the owner has it
    Simulator* simulator_;
    std::optional<Painter> painter_;
    std::optional<std::thread::id> gl_thread_;  // where its context is current
    nb::object owner_;
    Turn turn_;
};

}  // namespace gelatin::python
