#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace gelatin::test {

/// How a child process ended and what it said.
struct ProgramResult {
    int exit_code = -1;  ///< -1 if a signal ended it
    int signal = 0;
    std::string out, err;
};

struct ProgramSettings {
    std::vector<std::string> environment;  ///< "NAME=VALUE", on top of this process' own
    std::filesystem::path folder;          ///< to run in; empty: this process' own
    bool error_terminal = false;           ///< stderr is a terminal
    std::size_t largest_file = 0;  ///< no file may grow beyond [bytes], as on a full disk; 0: no limit
    std::string signal_after;      ///< once stderr has this text, `signals` are sent
    std::vector<int> signals;
    std::chrono::milliseconds signal_delay{0};  ///< between that text and the first signal
};

/// Runs the gelatin program with `arguments` and waits for its end; kills it after a minute and a half.
ProgramResult run_gelatin(const std::vector<std::string>& arguments, const ProgramSettings& settings = {});

/// The same for any program of the system; its name is looked up in PATH.
ProgramResult run_program(const std::vector<std::string>& command, const ProgramSettings& settings = {});

}  // namespace gelatin::test
