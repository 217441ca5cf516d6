#pragma once

#include <cstdint>

namespace gelatin {

/// A moment of a run.
struct Moment {
    int frame = 0;
    double time = 0.0;        ///< [s]
    std::uint64_t steps = 0;  ///< since frame 0
};

/// Where a run is. Times are counted from the start, so that a resumed run has exactly those of an
/// uninterrupted one.
class RunClock {
public:
    /// @param frame_time [s] @param substeps steps of a frame
    RunClock(double frame_time, int substeps) : frame_time_(frame_time), substeps_(substeps) {}

    void count_step() { ++steps_; }
    /// Counts from there on.
    void go_on_from(const Moment& moment);

    int substeps() const { return substeps_; }
    double step_size() const { return frame_time_ / substeps_; }  ///< [s]
    Moment now() const;
    double time() const { return now().time; }  ///< [s]
    bool is_at_end_of_frame() const { return steps_ % static_cast<std::uint64_t>(substeps_) == 0; }

private:
    double frame_time_;  // [s]
    int substeps_;
    Moment start_;             // of this run: where a checkpoint was loaded
    std::uint64_t steps_ = 0;  // since then
};

}  // namespace gelatin
