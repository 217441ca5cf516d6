#include <CLI/CLI.hpp>
#include <memory>

#include "bench_kernels.h"
#include "commands.h"

namespace gelatin {

void add_bench_command(CLI::App& app) {
    CLI::App* bench = app.add_subcommand("bench", "Measure speed on this machine");
    bench->require_subcommand(1);

    auto options = std::make_shared<KernelBenchOptions>();
    CLI::App* kernels =
        bench->add_subcommand("kernels", "Each stage on each backend: ms, bytes, rate, ratios");
    kernels->add_option("--json", options->json, "Also write the figures to this file");
    kernels->add_option("--runs", options->runs, "Samples of each stage; the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    kernels->add_option("--scales", options->scales, "Sizes, times three spheres of 4,580 nodes")
        ->delimiter(',')
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    kernels->add_flag("!--no-gl", options->use_gl, "Leave OpenGL out");
    kernels->callback([options] { bench_kernels(*options); });
}

}  // namespace gelatin
