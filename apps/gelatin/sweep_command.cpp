#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "commands.h"
#include "gelatin/error.h"

namespace gelatin {
namespace {

// Becomes the command of the Python package, or says that there is none.
constexpr const char* kProgram = R"(import sys
try:
    import gelatin.sweep_command
except ModuleNotFoundError as problem:
    sys.exit(f"gelatin: error: sweep needs the Python package (no module {problem.name!r} in {sys.executable}): "
             "pip install '.[sweep]' in Gelatin's folder; GELATIN_PYTHON=... names another Python")
sys.exit(gelatin.sweep_command.main(sys.argv[1:])))";

[[noreturn]] void run_in_python(std::vector<std::string> arguments) {
    const char* chosen = std::getenv("GELATIN_PYTHON");
    const std::string python = chosen != nullptr ? chosen : "python3";
    arguments.insert(arguments.begin(), {python, "-c", kProgram});
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    execvp(python.c_str(), words.data());
    throw Error("sweep needs the Python package, and " + python + " cannot be run: " + std::strerror(errno));
}

}  // namespace

void add_sweep_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("sweep", "Run a scene with varied settings, on many processors; in Python");
    command->set_help_flag();  // Python's help is the one with the options
    command->prefix_command();
    command->callback([command] { run_in_python(command->remaining()); });
}

}  // namespace gelatin
