#pragma once

namespace gelatin::viewer {

/// Decides how many steps to make so that simulated time follows real time.
///
/// Steps that cost more than their time are not made up for later, which would only cost more: the motion
/// slows down instead, and `achieved_speed` says by how much.
class Pace {
public:
    /// @param step_size [s], > 0
    explicit Pace(double step_size) : step_size_(step_size) {}

    /// Simulated seconds a real second, > 0: below 1 is slow motion.
    void set_speed(double speed) { speed_ = speed; }
    double speed() const { return speed_; }

    /// What a step has lately cost [s].
    void note_cost(double seconds_a_step);
    double cost() const { return cost_; }

    /// How many steps may be made before the next picture, > 0: those that take no longer than it may, but
    /// one at least.
    int most_steps() const;

    /// How many steps to make now that `elapsed` real seconds have gone by since the last call, >= 0: as many
    /// as follow them, but no more than most_steps().
    int steps_for(double elapsed);

    /// Forgets time that was due: after a pause, nothing is.
    void restart();

    /// Simulated seconds a real second of late; `speed()` where nothing is known yet.
    double achieved_speed() const;
    /// True if that is noticeably less than asked for.
    bool is_behind() const { return achieved_speed() < 0.9 * speed_; }

private:
    double step_size_;
    double speed_ = 1.0;
    double cost_ = 0.0;                       // [s], 0: not known
    double due_ = 0.0;                        // simulated time to make up for [s]
    double elapsed_ = 0.0, simulated_ = 0.0;  // fading sums [s]
};

}  // namespace gelatin::viewer
