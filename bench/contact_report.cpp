#include "bench/contact_report.h"

#include <fmt/format.h>

#include "bench/markdown_table.h"
#include "core/file.h"

namespace gelatin {
namespace {

constexpr const char* kContactMethod = R"(
## How it was measured

All systems make the same frames of 1/60 s, in which bodies press each other. A and B are `bench/peers/scene_a.toml` and
`bench/peers/scene_b.toml`, pile and rain `scenes/pile.toml` and `scenes/rain.toml`. The CPU makes the frames before, once. Each run begins with its
positions and velocities two frames before those that are timed. Larger sizes are copies of these bodies side by side, too far apart to meet.
No body is left out for being at rest.

- Means, medians and worst frames are by the host's clock, stages by the clock of the device on which they run; each is the median
  of all runs. Tries are those to make parts of a step, solved or not. Contacts are those that press, the mean of frames.
- Dispatches are counted in other frames of the same window. With work are those with work groups.
- Bytes are what elements move: a linearisation reads and writes each array once, an iteration of the solve the matrix and five fields of nodes.
  Left out are contacts, preconditioning, detection, guard and energies. On a device each iteration counts for all bodies, also those whose
  island has ended, so it may move less.
- The memory's limit is a copy of 128 MiB, read and written: on the CPU by as many threads as simulate, on the device by its driver. What
  caches hold may be faster.
)";

std::vector<std::string> all_stages() {
    std::vector<std::string> stages(kContactStages.begin(), kContactStages.end());
    stages.emplace_back(kOtherStages);
    return stages;
}

std::string time_table(const ContactBench& bench) {
    std::vector<std::string> header{"scene",    "size",  "system", "frames", "nodes",
                                    "contacts", "tries", "mean",   "median", "worst"};
    for (const std::string& stage : all_stages()) header.push_back(stage);
    MarkdownTable table(header, {4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    for (const ContactResult& r : bench.results) {
        std::vector<std::string> cells{r.scene->name,
                                       fmt::format("{}x", r.scale),
                                       r.system.name,
                                       fmt::format("{} to {}", r.scene->first + 1, r.scene->first + r.frames),
                                       std::to_string(r.nodes),
                                       fmt::format("{:.0f}", r.contacts()),
                                       format_figure(r.tries()),
                                       format_figure(r.mean()),
                                       format_figure(r.median()),
                                       format_figure(r.worst())};
        for (const std::string& stage : all_stages()) cells.push_back(format_figure(r.stage(stage)));
        table.add(cells);
    }
    return table.text();
}

std::string dispatch_table(const ContactBench& bench) {
    std::vector<std::string> header{"scene",  "size",           "all", "a try", "with work",
                                    "a part", "less iterations"};
    for (const std::string& stage : all_stages()) header.push_back(stage);
    MarkdownTable table(header, {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    const auto whole = [](double count) { return fmt::format("{:.0f}", count); };
    for (const ContactResult& r : bench.results) {
        if (!r.dispatches) continue;
        const ContactDispatches& d = *r.dispatches;
        std::vector<std::string> cells{r.scene->name,         fmt::format("{}x", r.scale),
                                       whole(d.all.launched), whole(d.all.launched / d.tries.launched),
                                       whole(d.all.working),  whole(d.all.working / d.tries.working),
                                       whole(d.of_part())};
        for (const std::string& stage : all_stages()) {
            const auto found = d.stages.find(stage);
            const ContactDispatches::Count count =
                found == d.stages.end() ? ContactDispatches::Count{} : found->second;
            cells.push_back(whole(count.launched) + " / " + whole(count.working));
        }
        table.add(cells);
    }
    return table.text();
}

std::string byte_table(const ContactBench& bench) {
    MarkdownTable table({"scene", "size", "system", "stage", "MB", "GB/s", "of the limit"}, {4, 5, 6});
    for (const ContactResult& r : bench.results) {
        for (const char* stage : kContactStages) {
            if (r.bytes(stage) == 0.0) continue;
            table.add({r.scene->name, fmt::format("{}x", r.scale), r.system.name, stage,
                       format_figure(1e-6 * r.bytes(stage)), format_figure(1e-9 * r.rate(stage)),
                       fmt::format("{:.0f}%", 100.0 * r.rate(stage) / bench.memory_rates.at(r.system.name))});
        }
    }
    return table.text();
}

std::string memory_table(const ContactBench& bench) {
    MarkdownTable table({"memory's limit", "GB/s"}, {1});
    for (const auto& [system, rate] : bench.memory_rates) table.add({system, format_figure(1e-9 * rate)});
    return table.text();
}

}  // namespace

std::string contact_tables(const ContactBench& bench) {
    std::string text = "## Milliseconds a frame, of all and by stage\n\n" + time_table(bench);
    for (const std::string& what : bench.left_out) text += "\nNot measured: " + what + ".\n";
    if (bench.options.use_gl)
        text +=
            "\n## Dispatches a frame, of all and by stage: launched / with work\n\n" + dispatch_table(bench);
    text += "\n## Bytes a frame\n\n" + byte_table(bench) + "\n" + memory_table(bench);
    if (const std::vector<BenchRatio> ratios = bench.ratios(); !ratios.empty())
        text += "\n## Ratios\n\n" + ratio_table(ratios);
    return text;
}

void write_contact_report(const std::filesystem::path& file, const ContactBench& bench) {
    const std::string chart = file.stem().string() + ".svg";
    MarkdownTable machine({"", ""}, {});
    add_machine_rows(bench.machine, machine);
    std::string settings =
        fmt::format("--runs {} --scales {}", bench.options.runs, fmt::join(bench.options.scales, ","));
    for (const std::string& only : bench.options.only) settings += fmt::format(" --only \"{}\"", only);
    if (bench.options.frames) settings += fmt::format(" --frames {}", *bench.options.frames);
    machine.add({"settings", "`" + settings + "`"});
    write_file(file, fmt::format("# Contact\n\n`gelatin bench contact`\n\n{}\n![Time a frame]({})\n\n{}{}",
                                 machine.text(), chart, contact_tables(bench), kContactMethod));
}

}  // namespace gelatin
