#pragma once

#include <nanobind/nanobind.h>

#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "gelatin/simulator.h"

namespace gelatin::python {

namespace nb = nanobind;

/// A simulator for Python: every call of it goes through `use`.
///
/// Calls from several threads never run at once, since the interpreter's lock is released while it steps: a
/// second one raises RuntimeError. With OpenGL all calls must come from the thread that made it.
class PythonSimulator {
public:
    PythonSimulator(nb::handle scene, const std::string& backend, std::optional<int> gl_device,
                    bool gl_debug);

    /// Runs `work` with the simulator, its context being current.
    template <class Work>
    decltype(auto) use(const Work& work) {
        const std::unique_lock<std::mutex> lock = take();
        return work(simulator_);
    }

    /// Makes `count` steps, or frames, without the interpreter's lock, and asks for signals every now and
    /// then.
    /// @throws Diverged; nanobind's python_error for a signal (Ctrl-C), after a whole step
    void step(std::int64_t count);
    void advance(std::int64_t frames);

private:
    std::unique_lock<std::mutex> take();
    void make_steps(std::int64_t count);

    Simulator simulator_;
    std::mutex mutex_;
    std::thread::id maker_ = std::this_thread::get_id();
};

}  // namespace gelatin::python
