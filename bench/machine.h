#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/markdown_table.h"
#include "gl/context.h"

namespace gelatin {

/// What a figure depends on beside the code.
struct BenchMachine {
    std::string cpu;     ///< "AMD EPYC"; "unknown" where the system does not tell
    int threads;         ///< that simulate
    std::string simd;    ///< instruction set of the CPU's kernels
    std::string opengl;  ///< renderer and version, and how many threads llvmpipe was told to use; "none"
    std::string compiler, build_type, flags;
};

/// @param device null where OpenGL is left out
BenchMachine describe_bench_machine(const gl::DeviceInfo* device);

/// The first rows of a report, version and commit before them: two columns.
void add_machine_rows(const BenchMachine& machine, MarkdownTable& table);

nlohmann::ordered_json machine_json(const BenchMachine& machine);

}  // namespace gelatin
