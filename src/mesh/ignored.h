#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// Counts what a file contains and a reader does not use: one line for each kind, in the order of the file.
class Ignored {
public:
    /// @param what as in "ignored lines: 3"
    void add(const std::string& what, std::size_t count = 1);
    void report(Notes& notes) const;

private:
    std::vector<std::pair<std::string, std::size_t>> counts_;
};

}  // namespace gelatin
