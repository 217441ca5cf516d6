#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gelatin {

/// How a child process ended, and its output on stdout and stderr together (the last 64 KiB).
struct ProcessResult {
    int exit_code = 0;  ///< if it exited by itself
    int signal = 0;     ///< if a signal ended it, else 0
    bool timed_out = false;
    std::string output;

    bool succeeded() const { return exit_code == 0 && signal == 0 && !timed_out; }
};

/// Runs a program by posix_spawnp (no shell) in its own process group, with stdin from /dev/null, and waits.
/// Kills the group after `time_limit` [s], or when this thread's listener cancels (progress.h).
/// @param folder the child's working folder
/// @throws SystemError if the program does not exist or cannot be started; Cancelled.
ProcessResult run_process(const std::vector<std::string>& command, const std::filesystem::path& folder,
                          double time_limit);

/// A running program that receives input through its stdin. This is a socket, so that the program's early end
/// is an error, not SIGPIPE. It runs in its own process group, so that Ctrl-C at the terminal does not reach
/// it. The destructor kills it if `finish` was not called.
class FedProcess {
public:
    /// @throws SystemError if the program does not exist or cannot be started.
    explicit FedProcess(const std::vector<std::string>& command);
    FedProcess(const FedProcess&) = delete;
    FedProcess& operator=(const FedProcess&) = delete;
    ~FedProcess();

    /// False once the program has closed its input or ended.
    bool write(const void* data, std::size_t bytes);

    /// Closes its input and waits until it ends.
    ProcessResult finish();

private:
    int pid_ = -1;
    int input_ = -1;
    int log_ = -1;  // an unlinked temporary file for its stdout and stderr
};

}  // namespace gelatin
