#pragma once

#include <csignal>

namespace gelatin {

/// During its lifetime, the first Ctrl-C (or SIGTERM) asks the program to finish; the second one ends it.
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
