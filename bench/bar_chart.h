#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gelatin {

/// Horizontal bars on a logarithmic axis, in panels one below the other.
struct BarChart {
    struct Bar {
        std::size_t series;
        double value;      ///< > 0
        double low, high;  ///< ends of the whisker; equal for none
    };
    struct Group {
        std::string label;
        std::vector<Bar> bars;
    };
    struct Panel {
        std::string title;
        std::vector<Group> groups;
    };
    std::string title;
    std::vector<std::string> series;  ///< at most three; each has a colour
    std::vector<Panel> panels;
};

/// An SVG picture.
std::string to_svg(const BarChart& chart);

}  // namespace gelatin
