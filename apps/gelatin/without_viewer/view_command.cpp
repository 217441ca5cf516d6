// In place of ../view_command.cpp where GELATIN_VIEWER is off.
#include <CLI/CLI.hpp>

#include "../commands.h"
#include "gelatin/error.h"

namespace gelatin {

void add_view_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("view", "Not in this program: it was built without its window");
    command->allow_extras();
    command->callback([] {
        throw InvalidInput(
            "view: this program was built without its window: see GELATIN_VIEWER in docs/embedding.md");
    });
}

}  // namespace gelatin
