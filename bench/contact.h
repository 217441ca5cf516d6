#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gelatin {

struct ContactBenchOptions {
    std::vector<int> scales{1};          ///< copies of each scene's bodies
    int runs = 3;                        ///< of each window; the median is reported
    std::optional<int> frames;           ///< of a window at most; empty: all of it
    std::vector<std::string> only;       ///< parts of the labels to measure, any of them; empty: all
    std::filesystem::path scenes;        ///< folder of the four scenes; empty: where each is in the sources
    bool use_gl = true;                  ///< measure steps on the device, too
    std::filesystem::path json, report;  ///< files; empty: none
};

/// Measures frames in which bodies press each other, on each backend: milliseconds by stage, dispatches,
/// bytes moved and how near that is to what memory can do. Prints tables, and the important ratios.
///
/// @throws InvalidInput for `only` that matches nothing, scenes without contact, and files that cannot be
///   written; NoOpenGl without OpenGL, unless it is excluded.
void bench_contact(const ContactBenchOptions& options);

}  // namespace gelatin
