#pragma once

#include <string>

#include "gl/context.h"

namespace gelatin {

/// What a figure depends on beside the code.
struct BenchMachine {
    std::string cpu;     ///< "AMD EPYC"; "unknown" where the system does not tell
    int threads;         ///< that simulate
    std::string simd;    ///< instruction set of the CPU's kernels
    std::string opengl;  ///< renderer and version
    std::string compiler, build_type, flags;
};

BenchMachine describe_bench_machine(const gl::DeviceInfo& device);

}  // namespace gelatin
