#pragma once

#include <chrono>
#include <string>

namespace gelatin {

/// Reports the progress of a run on stderr: a bar with percent, frames per second and the time left if stderr
/// is a terminal, otherwise a line after every tenth.
class Progress {
public:
    /// @param first frames that were done before (of a resumed run)
    Progress(int first, int total, bool quiet);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();  ///< ends the line on a terminal

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
