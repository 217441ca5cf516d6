#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "commands.h"
#include "core/log.h"
#include "gelatin/error.h"
#include "gelatin/version.h"

namespace gelatin {
namespace {

enum ExitCode { kDone = 0, kOtherError = 1, kWrongInput = 2, kDiverged = 3, kNoOpenGl = 4 };

int fail(ExitCode code, const std::string& message) {
    std::fprintf(stderr, "gelatin: error: %s\n", message.c_str());
    return code;
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
    add_mesh_command(app);
    add_info_command(app);
    add_bench_command(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        return fail(kWrongInput, std::string(error.what()) + " (gelatin --help-all shows what there is)");
    }
    return kDone;
}

}  // namespace
}  // namespace gelatin

int main(int argc, char** argv) {
    using namespace gelatin;
    set_up_log(false);
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
