#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/text_scanner.h"

namespace gelatin {

struct PlyType {
    std::string_view name, other_name;
    std::size_t size;
    double (*load)(std::string_view bytes, bool swapped);
};

struct PlyProperty {
    std::string name;
    const PlyType* type = nullptr;
    const PlyType* length_type = nullptr;  ///< of a list, else none
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    bool is_binary = false, is_swapped = false;
    std::vector<PlyElement> elements;
    std::size_t ignored_lines = 0;
};

/// Reads the header of a PLY file. The scanner stands at the first byte of the data afterwards.
PlyHeader read_ply_header(TextScanner& scanner);

}  // namespace gelatin
