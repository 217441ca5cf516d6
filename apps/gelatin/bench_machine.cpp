#include "bench_machine.h"

#include <tbb/info.h>

#include <fstream>

#include "cpu/advance_nodes.h"

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

}  // namespace

BenchMachine describe_bench_machine(const gl::DeviceInfo& device) {
    return {cpu_name(),
            tbb::info::default_concurrency(),
            cpu::simd_target(),
            device.renderer + ", OpenGL " + device.version,
            GELATIN_COMPILER,
            GELATIN_BUILD_TYPE,
            GELATIN_COMPILER_FLAGS};
}

}  // namespace gelatin
