#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/markdown_table.h"
#include "gl/context.h"

namespace gelatin {

/// What a figure depends on in addition to the code.
struct BenchMachine {
    std::string cpu;     ///< "AMD EPYC"; "unknown" if the system does not say
    int threads;         ///< threads that simulate
    std::string simd;    ///< instruction set of the CPU's kernels
    std::string opengl;  ///< renderer and version, and the number of threads set for llvmpipe; "none"
    std::string compiler, build_type, flags;
    double load;  ///< processes that ran or wanted to, the mean of the minute before
};

/// @param device null without OpenGL
BenchMachine describe_bench_machine(const gl::DeviceInfo* device);

/// The first rows of a report, beginning with version and commit: two columns.
void add_machine_rows(const BenchMachine& machine, MarkdownTable& table);

nlohmann::ordered_json machine_json(const BenchMachine& machine);

}  // namespace gelatin
