#include "viewer/support/display.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "support/run_program.h"
// After GoogleTest, whose names it has macros for.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

namespace gelatin::test {
namespace {

constexpr int kStartTime = 20000;  // [ms]

// Xvfb writes the number of the display that it has found free into a pipe. It ends with this process.
std::string start_xvfb() {
    int ends[2];
    if (pipe(ends) != 0) return {};
    const pid_t parent = getpid();
    if (fork() == 0) {
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (getppid() != parent) _exit(1);
        const int nowhere = open("/dev/null", O_RDWR);
        dup2(nowhere, 1);
        dup2(nowhere, 2);
        const std::string descriptor = std::to_string(ends[1]);
        execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1280x1024x24", "-noreset",
               nullptr);
        _exit(127);
    }
    close(ends[1]);
    std::string number;
    pollfd wait{ends[0], POLLIN, 0};
    for (char c = 0; poll(&wait, 1, kStartTime) > 0 && read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
    close(ends[0]);
    return number;
}

}  // namespace

VirtualDisplay& VirtualDisplay::instance() {
    static VirtualDisplay display;
    return display;
}

VirtualDisplay::VirtualDisplay() {
    const std::string number = start_xvfb();
    if (number.empty()) {
        why_not_ = "no Xvfb";
        return;
    }
    setenv("DISPLAY", (":" + number).c_str(), 1);
    if (run_program({"xdotool", "version"}).exit_code != 0) why_not_ = "no xdotool";
}

void VirtualDisplay::act(const std::vector<std::string>& actions) const {
    std::vector<std::string> command = {"xdotool"};
    command.insert(command.end(), actions.begin(), actions.end());
    const ProgramResult result = run_program(command);
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

void VirtualDisplay::set_density(int dots) const {
    Display* display = XOpenDisplay(nullptr);
    ASSERT_NE(display, nullptr);
    const std::string resources = "Xft.dpi:\t" + std::to_string(dots) + "\n";
    XChangeProperty(display, DefaultRootWindow(display), XA_RESOURCE_MANAGER, XA_STRING, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(resources.data()),
                    static_cast<int>(resources.size()));
    XCloseDisplay(display);
}

}  // namespace gelatin::test
