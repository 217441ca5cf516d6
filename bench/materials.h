#pragma once

#include <filesystem>
#include <vector>

namespace gelatin {

struct MaterialBenchOptions {
    int runs = 15;                                  ///< samples of each measurement; the median is reported
    int frequency = 20;                             ///< of the three balls: 20 frequency^2 faces each
    std::vector<int> beam_nodes{10, 10, 40};        ///< of SOFA's beam, across, across and along
    std::vector<int> iterations{2, 5, 10, 20, 40};  ///< of a step of the beam
    bool use_gl = true;
    std::filesystem::path json, report;  ///< files; empty: none
};

/// Measures what materials cost: implicit and explicit steps of the same balls with springs and neo-Hookean
/// tets, with and without volume term and damping, on each backend, in turn. Then implicit steps of a beam
/// whose times SOFA's authors have published, with their distances from the exact motion. Prints tables.
///
/// @throws InvalidInput for files that cannot be written; NoOpenGl without OpenGL, unless it is excluded.
void bench_materials(const MaterialBenchOptions& options);

}  // namespace gelatin
