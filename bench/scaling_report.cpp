#include "bench/scaling_report.h"

#include <fmt/core.h>

#include <array>

#include "bench/markdown_table.h"
#include "core/file.h"
#include "sim/report.h"

namespace gelatin {
namespace {

constexpr std::array kParts{ScalingPart::two_bodies, ScalingPart::faces, ScalingPart::objects,
                            ScalingPart::self_collision};

std::string ms(const BenchSummary& time) {
    return fmt::format("{:.4f}", time.median);
}
std::string per(const BenchSummary& time, double unit, std::size_t count) {
    return format_figure(time.median * unit / static_cast<double>(count));
}
constexpr double kNanoseconds = 1e6, kMicroseconds = 1e3;  // in a millisecond

// Of one part; empty if none of it was measured.
std::vector<const ScalingResult*> results_of(const ScalingBench& bench, ScalingPart part) {
    std::vector<const ScalingResult*> results;
    for (const ScalingResult& result : bench.results)
        if (result.part == part) results.push_back(&result);
    return results;
}

std::string two_bodies_table(const std::vector<const ScalingResult*>& results) {
    MarkdownTable table({"bodies", "faces by", "system", "refit ms", "query ms", "both ms", "spread",
                         "colliding faces", "steps"},
                        {3, 4, 5, 6, 7, 8});
    for (const ScalingResult* r : results) {
        table.add({r->scene, name_of(r->broad_phase), r->system, ms(r->refit()), ms(r->query()),
                   ms(r->step()), fmt::format("{:.0f}%", 100.0 * r->step().spread()),
                   std::to_string(r->colliding_faces), fmt::format("{} x {}", r->samples.size(), r->steps)});
    }
    return table.text();
}

std::string faces_table(const std::vector<const ScalingResult*>& results) {
    MarkdownTable table({"a body", "system", "refit ms", "refit ns a face", "query ms", "query ns a face",
                         "colliding faces", "loading s"},
                        {2, 3, 4, 5, 6, 7});
    for (const ScalingResult* r : results) {
        table.add({r->scene, r->system, ms(r->refit()), per(r->refit(), kNanoseconds, r->faces),
                   ms(r->query()), per(r->query(), kNanoseconds, r->faces),
                   std::to_string(r->colliding_faces), format_figure(r->loading)});
    }
    return table.text();
}

std::string objects_table(const std::vector<const ScalingResult*>& results) {
    const std::vector<BenchStage> stages = step_stages();
    std::vector<std::string> header{"objects", "system"};
    for (const BenchStage& stage : stages) header.emplace_back(stage.name);
    header.insert(header.end(), {"step ms", "us an object", "colliding faces", "lost", "loading s"});
    MarkdownTable table(header, {2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
    for (const ScalingResult* r : results) {
        std::vector<std::string> cells{r->scene, r->system};
        for (const BenchStage& stage : stages) cells.push_back(ms(r->time({stage.name})));
        cells.insert(cells.end(), {ms(r->step()), per(r->step(), kMicroseconds, r->objects),
                                   std::to_string(r->colliding_faces), std::to_string(r->lost_pairs),
                                   format_figure(r->loading)});
        table.add(cells);
    }
    return table.text();
}

double self_share(const ScalingResult& result) {
    return result.time({"find_self_collisions"}).median / result.time({"advance_nodes"}).median;
}

std::string self_collision_table(const std::vector<const ScalingResult*>& results) {
    MarkdownTable table({"scene", "system", "advance_nodes ms", "find_self_collisions ms", "share"},
                        {2, 3, 4});
    for (const ScalingResult* r : results) {
        table.add({r->scene, r->system, ms(r->time({"advance_nodes"})), ms(r->time({"find_self_collisions"})),
                   fmt::format("{:.0f}%", 100.0 * self_share(*r))});
    }
    return table.text();
}

struct PartReport {
    const char* title;
    std::string (*table)(const std::vector<const ScalingResult*>&);
};

PartReport report_of(ScalingPart part) {
    switch (part) {
        case ScalingPart::two_bodies:
            return {"Two bodies of 8,000 faces", two_bodies_table};
        case ScalingPart::faces:
            return {"By number of faces: two bodies that touch", faces_table};
        case ScalingPart::objects:
            return {"By number of objects of 80 faces", objects_table};
        case ScalingPart::self_collision:
            break;
    }
    return {"Undeformed bodies with themselves", self_collision_table};
}

constexpr const char* kScalingMethod = R"(
## How it was measured

Stages are timed by the clock of the device on which they run, GL_TIMESTAMP with OpenGL. A sample is the mean of a step over
as many steps as take 1/50 s, at least one, from the same state. A figure is the median of all samples. The
spread is (90th - 10th percentile) / median. The systems of a scene are measured alternately. Steps above 0.3 s are sampled three times.

- Refit is `update_boxes`, the query `find_object_pairs` and `find_face_collisions`. With `boxes` every face of one body is
  tested against every face of the other.
- **Two bodies**: spheres of the paper's size, 1.99 radii apart (touching) and one (deep).
- **By number of faces**: balls with a hole, so that they need no mesher, 1.99 radii apart. Loading is building the model,
  meshing included.
- **By number of objects**: balls of a jittered lattice in which they touch, and of one in which they do not. Lost are pairs for
  which a device's buffers had no room.
- **With themselves**: `free_fall.toml` and `rain.toml` with `self_collision = true`, as they start to fall.
)";

}  // namespace

std::string scaling_tables(const ScalingBench& bench) {
    std::string text;
    for (const ScalingPart part : kParts) {
        const std::vector<const ScalingResult*> results = results_of(bench, part);
        if (results.empty()) continue;
        text += fmt::format("## {}\n\n{}\n", report_of(part).title, report_of(part).table(results));
    }
    const std::vector<BenchRatio> ratios = bench.ratios();
    if (!ratios.empty()) text += "## Ratios\n\n" + ratio_table(ratios);
    return text;
}

void write_scaling_report(const std::filesystem::path& file, const ScalingBench& bench) {
    const std::string chart = file.stem().string() + ".svg";
    MarkdownTable machine({"", ""}, {});
    add_machine_rows(bench.machine, machine);
    machine.add({"settings", fmt::format("`--runs {}`", bench.options.runs)});
    write_file(file, fmt::format("# Collision by size\n\n`gelatin bench scaling`\n\n{}\n"
                                 "![Time by size]({})\n\n{}{}",
                                 machine.text(), chart, scaling_tables(bench), kScalingMethod));
}

}  // namespace gelatin
