#include "bench/materials_report.h"

#include <fmt/format.h>

#include "bench/beam.h"
#include "bench/markdown_table.h"
#include "core/file.h"

namespace gelatin {
namespace {

constexpr const char* kMaterialMethod = R"(
## How it was measured

Steps are `advance_nodes` alone, timed by the host's clock until the device is done. A sample is the mean of as many steps as take
about 5 ms, at least one. A figure is the median of all samples. The spread is (90th - 10th percentile) / median.

**Materials**: three balls of a radius of 0.5 m, 1e5 Pa, undamped unless damping is named, in free air, compressed to 0.95 along
y. Nothing collides. `implicit` takes steps of 1/60 s with `iterations = 10`, `semi_implicit_euler` half its largest stable one. Here and
below `iterations` are conjugate gradients at most, which end earlier where nothing is left to gain. The materials are measured in turn. A ratio is the median of the ratios of samples that were taken one after the other.

**SOFA's beam**: 10 x 10 x 40 nodes, 16 x 4 x 4 m, held at one end, under gravity of 9 m/s^2 across it, in steps of 0.01 s. The rates
of SOFA are those that its authors published in SofaCUDA_benchmarks.csv (applications/plugins/SofaCUDA in its repository): implicit
Euler with 20 iterations by conjugate gradients, with the processor or the graphics card named. The figures of Gelatin are from the
machine above. What differs:

- Tets: SOFA's are linear and corotational, Gelatin's neo-Hookean. Both have 2000 Pa, a Poisson's ratio of 0.3 and 50 kg in all.
- Damping of tets: SOFA's is Rayleigh's, with 0.1 for stiffness and for mass. Here the viscosity is 0.1 s times the elastic
  stiffness, but of the volume term, which is not damped. Damping in proportion to mass has no counterpart.
- Springs: SOFA's join the ends of the tets' edges with 1200 N/m each. Gelatin's are fitted to 2000 Pa at a Poisson's ratio of 1/4,
  and join more pairs of nodes. Both are undamped, of 100 kg in all. SOFA's nodes have equal masses, Gelatin's a quarter of each tet's.
- SOFA's steps stop at 20 iterations, or earlier where the residual is small. Their errors are not published.

The error of a step is the largest distance of a node from where the exact motion takes it from the same state, over the
largest displacement of a node in that step: the mean over the steps after 10, 25 and 50 steps of a run on the CPU with the largest
number of iterations. Single precision alone leaves up to 1e-4 of these displacements of centimetres.

- The exact motion is that of rk4 in double precision, in ten parts of the step or more, each at most 0.8 of the largest stable step.
  The change by twice as many is that of the last of these steps.
- Where more iterations lower the error no more, what is left is that of the scheme at this step: of implicit Euler by OpenGL, of BDF2
  on the CPU, linearised.
- The error of free motion is that of the same steps of nodes that feel gravity and no elastic force. A solver must reduce it.
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

std::string beam_table(const BeamBench& beam) {
    MarkdownTable table({"body", "by", "iterations", "steps/s", "spread", "error"}, {2, 3, 4, 5});
    for (const BeamReference& r : beam.references) {
        for (const BeamTime& t : beam.times) {
            if (t.body != r.body) continue;
            table.add({t.body, t.system, std::to_string(t.iterations), format_figure(t.rate()),
                       fmt::format("{:.0f}%", 100.0 * summarise(t.samples).spread()),
                       fmt::format("{:.1e}", t.error)});
        }
        for (const PublishedRate& p : published_beam_rates()) {
            if (p.body == r.body)
                table.add({p.body, fmt::format("SOFA, {}", p.device), "", format_figure(p.rate), "", ""});
        }
    }
    return table.text();
}

std::string reference_table(const BeamBench& beam) {
    MarkdownTable table({"body", "parts of an exact step", "change by twice as many", "error of free motion"},
                        {1, 2, 3});
    for (const BeamReference& r : beam.references) {
        table.add({r.body, std::to_string(r.parts), fmt::format("{:.1e}", r.change),
                   fmt::format("{:.1e}", r.free_error)});
    }
    return table.text();
}

std::string settings_text(const MaterialBenchOptions& options) {
    return fmt::format("`--runs {} --frequency {} --beam-nodes {} --iterations {}`", options.runs,
                       options.frequency, fmt::join(options.beam_nodes, "x"),
                       fmt::join(options.iterations, ","));
}

}  // namespace

std::string material_tables(const MaterialBench& bench) {
    return fmt::format("## Materials\n\n{}\n## SOFA's beam\n\n{}\n{}", materials_table(bench.materials),
                       beam_table(bench.beam), reference_table(bench.beam));
}

void write_material_report(const std::filesystem::path& file, const MaterialBench& bench) {
    MarkdownTable machine({"", ""}, {});
    add_machine_rows(bench.machine, machine);
    machine.add({"settings", settings_text(bench.options)});
    write_file(file, fmt::format("# Materials\n\n`gelatin bench materials`\n\n{}\n{}{}", machine.text(),
                                 material_tables(bench), kMaterialMethod));
}

}  // namespace gelatin
