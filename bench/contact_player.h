#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/contact_cases.h"
#include "bench/stages.h"
#include "gl/dispatch_counter.h"
#include "model/solver.h"

namespace gelatin {

/// What a window has taken once.
struct ContactSample {
    std::vector<double> frames;            ///< [ms]
    std::map<std::string, double> stages;  ///< "solve", ...: the mean of a frame [ms]
    double tries = 0.0;                    ///< that were launched a frame, to make parts of its step
    double multiplied_nodes = 0.0;         ///< by iterations of the solve, a frame; 0 on a device
    double contacts = 0.0;                 ///< that press, the mean of frames

    double mean() const;    ///< of frames [ms]
    double median() const;  ///< of frames [ms]
    double worst() const;   ///< of frames [ms]
};

/// Makes the frames of a window on one system, always from the same state.
class ContactPlayer {
public:
    ContactPlayer(const ContactCase& contact_case, const StageSystem& system, int frames);

    ContactSample sample();
    /// Of all frames of a window, by stage and program; not for a CPU.
    gl::DispatchCounter::Counts count_dispatches();

private:
    // A solver, and what ends a step of which it may have made a part only.
    struct Steps {
        std::unique_ptr<Solver> solver;
        std::function<void()> finish;
        std::function<double()> multiplied_nodes;  // so far
    };
    static Steps make_steps(const ContactCase& contact_case, bool uses_gl);
    void begin();
    void make_frame();

    StageSystem system_;
    State start_;
    double frame_time_;  // [s]
    int frames_;
    Steps steps_;
};

}  // namespace gelatin
