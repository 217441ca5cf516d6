#include "bench/kernel_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/kernel_cases.h"
#include "bench/markdown_table.h"
#include "core/file.h"
#include "gelatin/version.h"

namespace gelatin {
namespace {

using Json = nlohmann::ordered_json;

const char* const kKernelMethod = R"(
Medians of samples; the stages are sampled alternately. Spread is (90th - 10th percentile) / median. 1x is three spheres of 4,581
nodes, 22,638 springs and 8,000 faces each, damped, above a plane. MB is what a stage reads and writes at least once. An
implicit step is a frame of 1/60 s.
)";

const KernelTime& find_time(const std::vector<KernelTime>& times, const std::string& backend,
                            const std::string& stage, int scale) {
    return *std::find_if(times.begin(), times.end(), [&](const KernelTime& t) {
        return t.backend == backend && t.stage == stage && t.scale == scale;
    });
}

}  // namespace

std::vector<BenchRatio> KernelBench::ratios() const {
    const std::vector<int>& scales = options.scales;
    const std::string fused = kFusedStage, divided = kDividedStage;
    std::vector<std::string> backends{kPlainCore, kOneThread};
    if (options.use_gl) backends.emplace_back(kOpenGl);
    std::vector<BenchRatio> result;
    for (const int scale : scales) {
        const auto ms = [&](const std::string& b, const std::string& s) {
            return find_time(times, b, s, scale).ms.median;
        };
        for (const std::string& b : backends) {
            result.push_back({fmt::format("{}: divide and merge / fused, {}x", b, scale),
                              ms(b, divided) / ms(b, fused), b == kOpenGl ? ">= 2.5" : ""});
        }
        for (const std::string& b : backends) {
            if (b == kPlainCore) continue;
            result.push_back({fmt::format("{}: implicit step / fused, {}x", b, scale),
                              ms(b, kImplicitStage) / ms(b, fused), ""});
        }
        if (options.use_gl) {
            result.push_back({fmt::format("GL / plain C++, fused, {}x", scale),
                              ms(kOpenGl, fused) / ms(kPlainCore, fused), "<= 2 on llvmpipe"});
        }
        result.push_back({fmt::format("plain C++ / CPU on one thread, fused, {}x", scale),
                          ms(kPlainCore, fused) / ms(kOneThread, fused), ">= 2"});
    }
    for (const std::string& b : backends) {
        const int most = scales.back(), least = scales.front();
        const KernelTime& large = find_time(times, b, fused, most);
        const KernelTime& small = find_time(times, b, fused, least);
        result.push_back({fmt::format("{}: cost per spring, {}x / {}x", b, most, least),
                          large.ms.median / large.springs / (small.ms.median / small.springs), "<= 1.5"});
    }
    return result;
}

std::string kernel_tables(const KernelBench& bench) {
    MarkdownTable times({"backend", "stage", "scale", "ms", "spread", "MB", "GB/s", "ns a spring"},
                        {2, 3, 4, 5, 6, 7});
    for (const KernelTime& t : bench.times) {
        times.add({t.backend, t.stage, fmt::format("{}x", t.scale), fmt::format("{:.4f}", t.ms.median),
                   fmt::format("{:.0f}%", 100 * t.ms.spread()), fmt::format("{:.2f}", t.bytes / 1e6),
                   fmt::format("{:.2f}", t.bytes / t.ms.median / 1e6),
                   fmt::format("{:.2f}", 1e6 * t.ms.median / t.springs)});
    }
    return times.text() + "\n" + ratio_table(bench.ratios());
}

std::string kernel_json(const KernelBench& bench) {
    Json stages = Json::array();
    for (const KernelTime& t : bench.times) {
        stages.push_back({{"backend", t.backend},
                          {"stage", t.stage},
                          {"scale", t.scale},
                          {"ms", t.ms.median},
                          {"spread", t.ms.spread()},
                          {"least", t.least},
                          {"bytes", t.bytes},
                          {"springs", t.springs}});
    }
    const Json document = {{"gelatin", {{"version", version()}, {"commit", commit()}}},
                           {"benchmark", "kernels"},
                           {"machine", machine_json(bench.machine)},
                           {"settings", {{"runs", bench.options.runs}}},
                           {"stages", stages},
                           {"ratios", ratios_json(bench.ratios())}};
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_kernel_report(const std::filesystem::path& file, const KernelBench& bench) {
    MarkdownTable machine({"", ""}, {});
    add_machine_rows(bench.machine, machine);
    machine.add({"settings", fmt::format("`--runs {}`", bench.options.runs)});
    write_file(file, fmt::format("# Stages\n\n`gelatin bench kernels`\n\n{}\n{}{}", machine.text(),
                                 kernel_tables(bench), kKernelMethod));
}

}  // namespace gelatin
