#pragma once

#include <csignal>

namespace gelatin {

/// While one lives, the first Ctrl-C (or SIGTERM) asks the program to come to an end by itself; the second
/// ends it.
class Interrupt {
public:
    Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;
    ~Interrupt();

    bool was_asked() const;

private:
    struct sigaction old_interrupt_ {};
    struct sigaction old_terminate_ {};
};

}  // namespace gelatin
