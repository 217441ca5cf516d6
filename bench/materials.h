#pragma once

#include <filesystem>

namespace gelatin {

struct MaterialBenchOptions {
    int runs = 15;       ///< samples of each measurement; the median is reported
    int frequency = 20;  ///< of the three balls: 20 frequency^2 faces each
    bool use_gl = true;
    std::filesystem::path json, report;  ///< files; empty: none
};

/// Measures what materials cost: implicit and explicit steps of the same balls with springs and neo-Hookean
/// tets, with and without volume term and damping, on each backend, in turn. Prints a table.
///
/// @throws InvalidInput for files that cannot be written; NoOpenGl without OpenGL, unless it is excluded.
void bench_materials(const MaterialBenchOptions& options);

}  // namespace gelatin
