#include "support/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace gelatin::test {
namespace {

constexpr std::chrono::seconds kLongest{90};
constexpr std::chrono::milliseconds kBetweenSignals{300};  // two at once would arrive as one

struct Channel {
    int reader = -1, writer = -1;
};

Channel open_pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    return {ends[0], ends[1]};
}

Channel open_terminal() {
    Channel channel;
    winsize size{};
    size.ws_row = 24;
    size.ws_col = 120;
    if (::openpty(&channel.reader, &channel.writer, nullptr, nullptr, &size) != 0)
        throw std::runtime_error("no pty");
    return channel;
}

// Between fork and exec; whatever fails here shows as exit code 127.
[[noreturn]] void become(const std::vector<std::string>& command, const ProgramSettings& settings, int out,
                         int err) {
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    if (!settings.folder.empty() && ::chdir(settings.folder.c_str()) != 0) ::_exit(127);
    if (settings.largest_file > 0) {
        const rlimit limit{settings.largest_file, settings.largest_file};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        std::signal(SIGXFSZ, SIG_IGN);  // write() fails instead, as on a full disk
    }
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    ::setenv("GELATIN_GL_HAZARDS", "1", 0);  // a missing barrier makes the program fail
    for (const std::string& variable : settings.environment) ::putenv(const_cast<char*>(variable.c_str()));
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
}

// False at the end of the channel.
bool read_some(int descriptor, std::string& text) {
    char bytes[4096];
    const ssize_t count = ::read(descriptor, bytes, sizeof bytes);
    if (count > 0) text.append(bytes, static_cast<std::size_t>(count));
    return count > 0;
}

void listen(pid_t child, const ProgramSettings& settings, int out, int err, ProgramResult& result) {
    const auto deadline = std::chrono::steady_clock::now() + kLongest;
    bool out_open = true, err_open = true;
    std::size_t sent = 0;
    std::optional<std::chrono::steady_clock::time_point> next_signal;
    while (out_open || err_open) {
        pollfd sources[2] = {{out_open ? out : -1, POLLIN, 0}, {err_open ? err : -1, POLLIN, 0}};
        ::poll(sources, 2, 100);
        if (sources[0].revents != 0) out_open = read_some(out, result.out);
        if (sources[1].revents != 0) err_open = read_some(err, result.err);
        const auto now = std::chrono::steady_clock::now();
        if (!next_signal && result.err.find(settings.signal_after) != std::string::npos)
            next_signal = now + settings.signal_delay;
        if (next_signal && sent < settings.signals.size() && now >= *next_signal) {
            ::kill(child, settings.signals[sent++]);
            next_signal = now + kBetweenSignals;
        }
        if (now > deadline) ::kill(child, SIGKILL);
    }
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& command, const ProgramSettings& settings) {
    const Channel out = open_pipe();
    const Channel err = settings.error_terminal ? open_terminal() : open_pipe();
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) become(command, settings, out.writer, err.writer);
    ::close(out.writer);
    ::close(err.writer);
    ProgramResult result;
    listen(child, settings, out.reader, err.reader, result);
    int status = 0;
    ::waitpid(child, &status, 0);
    ::close(out.reader);
    ::close(err.reader);
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    return result;
}

ProgramResult run_gelatin(const std::vector<std::string>& arguments, const ProgramSettings& settings) {
    std::vector<std::string> command = {GELATIN_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run_program(command, settings);
}

}  // namespace gelatin::test
