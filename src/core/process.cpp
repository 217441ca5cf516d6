#include "core/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "core/progress.h"
#include "gelatin/error.h"

namespace gelatin {
namespace {

constexpr std::size_t kOutputLimit = 64 * 1024;

[[noreturn]] void fail(const std::string& program, int reason) {
    throw SystemError(program + ": cannot be started: " + std::strerror(reason));
}

// A file descriptor that is closed by its destructor.
class Descriptor {
public:
    explicit Descriptor(int value = -1) : value_(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }

    int get() const { return value_; }
    int release() { return std::exchange(value_, -1); }
    void close() {
        if (value_ >= 0) ::close(std::exchange(value_, -1));
    }

private:
    int value_;
};

// Starts `command` in its own process group. Its stdout and stderr go to `output`; its stdin comes from
// `input`, or from /dev/null if that is -1. Signals that this process ignores or blocks reach the child as
// usual. Returns the child's process id.
int spawn(const std::vector<std::string>& command, const std::string& folder, int input, int output) {
    assert(!command.empty());
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    if (input >= 0) {
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    } else {
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    }
    if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());

    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

    pid_t pid = -1;
    const int error = posix_spawnp(&pid, arguments[0], &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) fail(command[0], error);
    return pid;
}

int wait_for_end(int pid) {
    int status = 0;
    while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

void store_status(ProcessResult& result, int status) {
    if (WIFSIGNALED(status)) {
        result.signal = WTERMSIG(status);
    } else {
        result.exit_code = WEXITSTATUS(status);
    }
}

// Appends what a non-blocking pipe holds, at most one pipe's capacity: a program that writes endlessly must
// not keep its caller from checking the time. Returns false at the end of the output.
bool drain(int pipe, std::string& output) {
    std::vector<char> chunk(kOutputLimit);
    const ssize_t n = ::read(pipe, chunk.data(), chunk.size());
    if (n < 0) return errno == EAGAIN || errno == EINTR;
    output.append(chunk.data(), static_cast<std::size_t>(n));
    if (output.size() > kOutputLimit) output.erase(0, output.size() - kOutputLimit);
    return n > 0;
}

// An unlinked file below the system's temporary folder.
int open_nameless_file(const std::string& program) {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    std::string name = ((error ? "/tmp" : folder) / "gelatin-log-XXXXXX").string();
    const int descriptor = ::mkostemp(name.data(), O_CLOEXEC | O_APPEND);
    if (descriptor < 0) fail(program, errno);
    ::unlink(name.c_str());
    return descriptor;
}

std::string read_tail(int file) {
    struct stat status {};
    if (::fstat(file, &status) != 0) return {};
    const off_t limit = static_cast<off_t>(kOutputLimit);
    const off_t start = std::max<off_t>(0, status.st_size - limit);
    std::string tail(static_cast<std::size_t>(status.st_size - start), '\0');
    const ssize_t n = ::pread(file, tail.data(), tail.size(), start);
    tail.resize(static_cast<std::size_t>(std::max<ssize_t>(0, n)));
    return tail;
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command, const std::filesystem::path& folder,
                          double time_limit) {
    using Clock = std::chrono::steady_clock;
    constexpr int kLookEvery = 5;  // [ms]

    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail(command[0], errno);
    const Descriptor reading(ends[0]);
    Descriptor writing(ends[1]);
    ::fcntl(reading.get(), F_SETFL, O_NONBLOCK);  // only this end: the child's end stays blocking
    const auto start = Clock::now();
    const int pid = spawn(command, folder.string(), -1, writing.get());
    writing.close();

    // The end of the output and the end of the child come in either order: a child may close its output and
    // continue, or leave a grandchild behind that keeps it open.
    ProcessResult result;
    bool open = true;
    int status = 0;
    while (::waitpid(pid, &status, WNOHANG) == 0) {
        if (std::chrono::duration<double>(Clock::now() - start).count() > time_limit) {
            result.timed_out = true;
            ::kill(-pid, SIGKILL);
            status = wait_for_end(pid);
            break;
        }
        try {
            check_cancelled();
        } catch (...) {
            ::kill(-pid, SIGKILL);
            wait_for_end(pid);
            throw;
        }
        pollfd waiting{open ? reading.get() : -1, POLLIN, 0};
        ::poll(&waiting, 1, kLookEvery);
        if (open) open = drain(reading.get(), result.output);
    }
    if (open) drain(reading.get(), result.output);
    store_status(result, status);
    return result;
}

FedProcess::FedProcess(const std::vector<std::string>& command) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(command[0], errno);
    Descriptor ours(ends[0]);
    const Descriptor theirs(ends[1]);
    Descriptor log(open_nameless_file(command[0]));
    pid_ = spawn(command, {}, theirs.get(), log.get());
    input_ = ours.release();
    log_ = log.release();
}

FedProcess::~FedProcess() {
    if (pid_ < 0) return;
    ::kill(-pid_, SIGKILL);
    finish();
}

bool FedProcess::write(const void* data, std::size_t bytes) {
    const char* rest = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t n = ::send(input_, rest, bytes, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        rest += n;
        bytes -= static_cast<std::size_t>(n);
    }
    return true;
}

ProcessResult FedProcess::finish() {
    assert(pid_ >= 0);
    ::close(std::exchange(input_, -1));
    ProcessResult result;
    store_status(result, wait_for_end(std::exchange(pid_, -1)));
    result.output = read_tail(log_);
    ::close(std::exchange(log_, -1));
    return result;
}

}  // namespace gelatin
