#include "bench/report.h"

#include <fmt/core.h>

#include "bench/markdown_table.h"
#include "core/counted.h"
#include "core/file.h"

namespace gelatin {
namespace {

std::string name_of_scene(std::size_t scene) {
    return bench_scenes()[scene].name;
}

std::string describe_timing(const BenchResult& result) {
    if (!result.sampled) return "whole: " + counted(result.window_frames, "frame");
    return fmt::format("sampled: {} of {}", counted(result.window_count, "window"),
                       counted(result.window_frames, "frame"));
}

std::string describe_scene(const BenchSceneFacts& facts) {
    const Counts& counts = facts.counts;
    return fmt::format("{}, {}, {}, {}; {}, the first {} without contact", counted(counts.objects, "object"),
                       counted(counts.nodes, "node"), counted(counts.springs, "spring"),
                       counted(counts.faces, "face"), counted(facts.frames, "frame"),
                       facts.contact_free_frames);
}

std::string scene_table(const PaperBench& bench, std::size_t scene) {
    MarkdownTable table(
        {"system", "drawn", "paper FPS", "mean FPS", "deviation", "min", "max", "ours / paper", "timed"},
        {2, 3, 4, 5, 6, 7});
    for (const BenchResult& result : bench.results) {
        if (result.scene != scene) continue;
        const BenchSpread spread = result.spread();
        table.add({result.system.name, result.drawn ? "yes" : "no", format_figure(result.paper_fps()),
                   format_figure(spread.mean), format_figure(spread.standard_deviation),
                   format_figure(spread.least), format_figure(spread.most),
                   format_figure(spread.mean / result.paper_fps()) + "x", describe_timing(result)});
    }
    return table.text();
}

std::string ratio_text(std::optional<double> ratio) {
    return ratio ? format_figure(*ratio) + "x" : "-";
}

std::string ratio_table(const PaperBench& bench) {
    MarkdownTable table({"times faster", "scene", "paper", "drawn", "undrawn"}, {2, 3, 4});
    for (const BenchComparison& comparison : bench_comparisons()) {
        for (const BenchSceneFacts& facts : bench.scenes) {
            const std::optional<double> drawn = bench.ratio(facts.scene, comparison, true),
                                        undrawn = bench.ratio(facts.scene, comparison, false);
            if (!drawn && !undrawn) continue;
            table.add({comparison.name, name_of_scene(facts.scene),
                       format_figure(comparison.paper[facts.scene]) + "x", ratio_text(drawn),
                       ratio_text(undrawn)});
        }
    }
    return table.text();
}

std::string machine_table(const PaperBench& bench) {
    MarkdownTable table({"", ""}, {});
    add_machine_rows(bench.machine, table);
    table.add({"picture", bench.picture});
    table.add({"settings",
               fmt::format("`--runs {} --whole-limit {} --windows {} --window-frames {}`", bench.options.runs,
                           bench.options.whole_limit, bench.options.windows, bench.options.window_frames)});
    return table.text();
}

constexpr const char* kPaperMethod = R"(
## How it was measured

A figure is the mean of all runs. Each run's is frames divided by wall-clock seconds, everything included: steps and, if drawn,
normals, light and picture, until the last one is finished. At most one frame is pending while the next is submitted to the
driver. Loading a scene and compiling shaders do not count. The systems are measured alternately.

Systems that would take longer than `--whole-limit` seconds for a whole run are sampled: a fast run saves its state at
evenly distributed frames, and a run times the next few frames from each of these states, so that frames in contact have the
same share as in a whole run. "Until contact" excludes all frames from the first one with colliding faces on.

- **paper, CPU single core**: spring forces divided and merged, boxes, one thread; drawn with OpenGL, one after the other.
- **paper, GPU**: the same in compute shaders. The paper's Table 4 compares boxes and none up to the first contact.
- **fast**: fused kernels and a hierarchy of boxes, on the backend that `auto` selects. If that is the CPU, a frame is
  simulated by all threads while the previous one is drawn. Its figures are compared with those of the paper's GPU.
- **fast, GL**: the same in compute shaders, if OpenGL is a software driver.

The paper's machine: GeForce GTX 760 Ti, Core i7-3770K; all its frames are drawn.
)";

}  // namespace

std::string bench_tables(const PaperBench& bench) {
    std::string text;
    for (const BenchSceneFacts& facts : bench.scenes) {
        text += fmt::format("## {}\n\n{}\n\n{}\n", name_of_scene(facts.scene), describe_scene(facts),
                            scene_table(bench, facts.scene));
    }
    return text + "## Ratios\n\n" + ratio_table(bench);
}

void write_bench_report(const std::filesystem::path& file, const PaperBench& bench) {
    const std::string chart = file.stem().string() + ".svg";
    write_file(file, fmt::format("# The paper's benchmark\n\n`gelatin bench paper`\n\n{}\n"
                                 "![Frames per second]({})\n\n{}{}",
                                 machine_table(bench), chart, bench_tables(bench), kPaperMethod));
}

}  // namespace gelatin
