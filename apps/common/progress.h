#pragma once

#include <chrono>
#include <string>

namespace gelatin {

/// Tells on stderr how far a run is: a bar with percent, frames a second and the time left where stderr is a
/// terminal, else one line every tenth.
class Progress {
public:
    /// @param first frames that were done before (a resumed run)
    Progress(int first, int total, bool quiet);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();  ///< leaves the terminal on a line of its own

    void update(int done);

private:
    using Clock = std::chrono::steady_clock;

    std::string describe(int done, Clock::time_point now) const;
    void draw_bar(int done, Clock::time_point now);

    int first_, total_;
    bool quiet_, is_terminal_;
    bool has_bar_ = false;
    int tenths_told_ = 0;
    Clock::time_point start_, last_drawn_{};
};

/// "42 s", "3 min 05 s", "2 h 07 min".
std::string describe_duration(double seconds);

}  // namespace gelatin
