#pragma once

namespace gelatin::viewer {

/// Decides how many steps to make so that simulated time follows real time.
///
/// If steps cost more than the time that they simulate, the delay is not made up for later: the motion slows
/// down, and `achieved_speed` says by how much.
class Pace {
public:
    /// @param step_size [s], > 0
    explicit Pace(double step_size) : step_size_(step_size) {}

    /// Simulated seconds per real second, > 0: below 1 is slow motion.
    void set_speed(double speed) { speed_ = speed; }
    double speed() const { return speed_; }

    /// The recent cost of a step [s].
    void note_cost(double seconds_a_step);
    double cost() const { return cost_; }

    /// How many steps may be made before the next picture, > 0: those that take no longer than a picture may,
    /// but at least one.
    int most_steps() const;

    /// How many steps to make after `elapsed` real seconds since the last call, >= 0: as many as simulated
    /// time lags behind, but at most most_steps().
    int steps_for(double elapsed);

    /// Discards time that was due: after a pause, none is.
    void restart();

    /// Recent simulated seconds per real second; `speed()` if nothing is known yet.
    double achieved_speed() const;
    /// True if that is noticeably less than requested.
    bool is_behind() const { return achieved_speed() < 0.9 * speed_; }

private:
    double step_size_;
    double speed_ = 1.0;
    double cost_ = 0.0;                       // [s], 0: not known
    double due_ = 0.0;                        // simulated time that is due [s]
    double elapsed_ = 0.0, simulated_ = 0.0;  // fading sums [s]
};

}  // namespace gelatin::viewer
