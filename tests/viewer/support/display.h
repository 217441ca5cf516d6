#pragma once

#include <string>
#include <vector>

namespace gelatin::test {

/// A display without a screen for this process, and hands that use it: Xvfb and xdotool.
class VirtualDisplay {
public:
    /// The process' one, started on the first call; it ends with the process. Sets DISPLAY.
    static VirtualDisplay& instance();

    /// Why there is none; empty if there is.
    const std::string& why_not() const { return why_not_; }

    /// One call of xdotool: {"mousemove", "10", "20", "click", "1"}. Returns when the display has taken it
    /// in.
    void act(const std::vector<std::string>& actions) const;

    /// What programs that start from now on take the screen's density for; usual is 96 [dots an inch].
    void set_density(int dots) const;

private:
    VirtualDisplay();

    std::string why_not_;
};

}  // namespace gelatin::test
