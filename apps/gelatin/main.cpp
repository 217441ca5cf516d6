#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "core/log.h"
#include "gelatin/error.h"
#include "gelatin/version.h"
#include "gl/hazards.h"
#include "model/scene/names.h"

namespace gelatin {
namespace {

// Exit codes; docs/command-line.md.
constexpr int kDone = 0, kOtherError = 1, kWrongInput = 2, kDiverged = 3, kNoOpenGl = 4;

int fail(int code, const std::string& message) {
    std::fprintf(stderr, "gelatin: error: %s\n", message.c_str());
    return code;
}

// CLI11 would only say that a command is required.
void check_command_name(const CLI::App& app, const std::string& name) {
    if (name.empty() || name.front() == '-') return;
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    throw InvalidInput("there is no command \"" + name + "\"" + suggestion(name, names) + "; there are " +
                       join_names(names));
}

int run(int argc, char** argv) {
    CLI::App app{
        "Simulates volumetric deformable objects: meshes become soft bodies that fall, bounce and are "
        "filmed.",
        "gelatin"};
    app.set_version_flag("--version", std::string("gelatin ") + version() + " (" + commit() + ")");
    app.set_help_all_flag("--help-all", "Show the options of every command");
    app.require_subcommand(1);
    add_run_command(app);
    add_render_command(app);
    add_export_command(app);
    add_view_command(app);
    add_mesh_command(app);
    add_info_command(app);
    add_bench_command(app);
    add_sweep_command(app);
    if (argc > 1) check_command_name(app, argv[1]);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        const std::vector<CLI::App*> chosen = app.get_subcommands();
        const std::string command = chosen.empty() ? "gelatin" : "gelatin " + chosen.front()->get_name();
        return fail(kWrongInput, std::string(error.what()) + " (see " + command + " --help)");
    }
    return kDone;
}

// GELATIN_GL_HAZARDS: 1 makes an access to a buffer that no barrier orders an error; "unneeded" lists the
// barriers that none needed, too. docs/command-line.md.
std::string_view hazard_setting() {
    const char* value = std::getenv("GELATIN_GL_HAZARDS");
    return value == nullptr || std::string_view(value) == "0" ? "" : value;
}

int report_hazards(int code) {
    if (hazard_setting() == "unneeded") {
        for (const std::string& line : gl::unneeded_barriers()) std::fprintf(stderr, "%s\n", line.c_str());
    }
    const std::vector<std::string> hazards = gl::take_hazards();
    if (hazards.empty()) return code;
    std::string message = "accesses to buffers on the GPU that no barrier orders:";
    for (const std::string& hazard : hazards) message += "\n  " + hazard;
    return fail(kOtherError, message);
}

int run_program(int argc, char** argv) {
    set_up_log(LogLevel::notes);
    try {
        return run(argc, argv);
    } catch (const InvalidInput& error) {
        return fail(kWrongInput, error.what());
    } catch (const Diverged& error) {
        return fail(kDiverged, error.what());
    } catch (const NoOpenGl& error) {
        return fail(kNoOpenGl, error.what());
    } catch (const std::bad_alloc&) {
        return fail(kOtherError, "out of memory");
    } catch (const std::exception& error) {
        return fail(kOtherError, error.what());
    }
}

int run_with_hazards_tracked(int argc, char** argv) {
    if (hazard_setting().empty()) return run_program(argc, argv);
    gl::enable_hazard_tracking();
    return report_hazards(run_program(argc, argv));
}

}  // namespace
}  // namespace gelatin

int main(int argc, char** argv) {
    return gelatin::run_with_hazards_tracked(argc, argv);
}
