#include "bench/machine.h"

#include <fmt/core.h>
#include <tbb/info.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/counted.h"
#include "cpu/explicit/advance_nodes.h"
#include "gelatin/version.h"

namespace gelatin {
namespace {

std::string cpu_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

double mean_load() {
    double load = 0.0;
    getloadavg(&load, 1);
    return load;
}

std::string describe_opengl(const gl::DeviceInfo* device) {
    if (device == nullptr) return "none";
    std::string text = device->renderer + ", OpenGL " + device->version;
    const char* threads = std::getenv("LP_NUM_THREADS");  // llvmpipe's; it uses all if nothing is set
    if (device->is_software && threads != nullptr) text += std::string(", LP_NUM_THREADS=") + threads;
    return text;
}

}  // namespace

BenchMachine describe_bench_machine(const gl::DeviceInfo* device) {
    return {cpu_name(),
            tbb::info::default_concurrency(),
            cpu::simd_target(),
            describe_opengl(device),
            GELATIN_COMPILER,
            GELATIN_BUILD_TYPE,
            GELATIN_COMPILER_FLAGS,
            mean_load()};
}

void add_machine_rows(const BenchMachine& machine, MarkdownTable& table) {
    table.add({"gelatin", fmt::format("{} ({})", version(), commit())});
    table.add({"OpenGL", machine.opengl});
    table.add(
        {"CPU", fmt::format("{}, {}, {}", machine.cpu, counted(machine.threads, "thread"), machine.simd)});
    table.add({"load", fmt::format("{:.1f} in the minute before", machine.load)});
    table.add({"build", fmt::format("{}, {}: `{}`", machine.compiler, machine.build_type, machine.flags)});
}

nlohmann::ordered_json machine_json(const BenchMachine& machine) {
    return {{"cpu", machine.cpu},       {"threads", machine.threads},   {"simd", machine.simd},
            {"opengl", machine.opengl}, {"compiler", machine.compiler}, {"build_type", machine.build_type},
            {"flags", machine.flags},   {"load", machine.load}};
}

}  // namespace gelatin
