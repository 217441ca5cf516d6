#pragma once

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace gelatin {

/// Each adds its subcommand, with all its options, to `app`. The subcommand's callback does the work and
/// throws gelatin::Error. main() turns exceptions into one line on stderr and the exit codes of
/// docs/command-line.md.
void add_run_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_view_command(CLI::App& app);
void add_mesh_command(CLI::App& app);
void add_info_command(CLI::App& app);
void add_bench_command(CLI::App& app);
void add_sweep_command(CLI::App& app);

}  // namespace gelatin
