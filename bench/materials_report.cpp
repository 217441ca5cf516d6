#include "bench/materials_report.h"

#include <fmt/core.h>

#include "bench/markdown_table.h"
#include "core/file.h"

namespace gelatin {
namespace {

constexpr const char* kMethod = R"(
## How it was measured

Steps are `advance_nodes` alone, timed by the host's clock until the device is done. A sample is the mean of as many steps as take
about 5 ms, at least one. A figure is the median of all samples. The spread is (90th - 10th percentile) / median.

**Materials**: three balls of a radius of 0.5 m, 1e5 Pa, undamped unless damping is named, in free air, compressed to 0.95 along
y. Nothing collides. `vbd` takes steps of 1/60 s with ten sweeps, `semi_implicit_euler` half its largest stable one. The materials are
measured in turn. A ratio is the median of the ratios of samples that were taken one after the other.
)";

std::string materials_table(const std::vector<MaterialTime>& times) {
    MarkdownTable table({"solver", "system", "material", "step ms", "computed in ms", "spread", "ratio"},
                        {3, 4, 5, 6});
    for (const MaterialTime& t : times) {
        const BenchSummary ms = summarise(t.samples);
        table.add({t.solver, t.system, t.material, fmt::format("{:.3f}", 1e3 * t.step),
                   fmt::format("{:.3f}", ms.median), fmt::format("{:.0f}%", 100.0 * ms.spread()),
                   format_figure(t.ratio())});
    }
    return table.text();
}

}  // namespace

std::string material_tables(const MaterialBench& bench) {
    return fmt::format("## Materials\n\n{}", materials_table(bench.materials));
}

void write_material_report(const std::filesystem::path& file, const MaterialBench& bench) {
    MarkdownTable machine({"", ""}, {});
    add_machine_rows(bench.machine, machine);
    machine.add(
        {"settings", fmt::format("`--runs {} --frequency {}`", bench.options.runs, bench.options.frequency)});
    write_file(file, fmt::format("# Materials\n\n`gelatin bench materials`\n\n{}\n{}{}", machine.text(),
                                 material_tables(bench), kMethod));
}

}  // namespace gelatin
