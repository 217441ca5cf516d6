#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "mesh/ignored.h"
#include "mesh/ply_header.h"
#include "mesh/surface_readers.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

constexpr std::array kNormal = {"nx", "ny", "nz"};

bool is_corner_list(const PlyProperty& property) {
    return property.length_type != nullptr &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// The axis of a coordinate; -1: another property.
int axis_of(const PlyProperty& property) {
    const bool is_axis = property.length_type == nullptr && property.name.size() == 1;
    return is_axis && property.name[0] >= 'x' && property.name[0] <= 'z' ? property.name[0] - 'x' : -1;
}

class PlyReader {
public:
    PlyReader(const std::filesystem::path& file, std::string_view content) : scanner_(file, content, 0) {}

    SurfacePolygons read(Notes& notes) {
        header_ = read_ply_header(scanner_);
        ignored_.add("lines of the header that are no statements", header_.ignored_lines);
        find_vertices();
        for (const PlyElement& element : header_.elements) read_element(element);
        read_end();
        ignored_.report(notes);
        return std::move(polygons_);
    }

private:
    void find_vertices() {
        const auto vertices =
            std::find_if(header_.elements.begin(), header_.elements.end(),
                         [](const PlyElement& element) { return element.name == "vertex"; });
        if (vertices == header_.elements.end()) scanner_.fail("element vertex", {}, "is missing");
        const auto& properties = vertices->properties;
        if (std::count_if(properties.begin(), properties.end(),
                          [](const PlyProperty& property) { return axis_of(property) >= 0; }) != 3)
            scanner_.fail("element vertex", {}, "must have the properties x, y and z");
        vertex_count_ = vertices->count;
    }

    void read_element(const PlyElement& element) {
        require_room(element);
        const bool is_vertex = element.name == "vertex", is_face = element.name == "face",
                   is_strip = element.name == "tristrips",
                   has_corners =
                       (is_face || is_strip) &&
                       std::any_of(element.properties.begin(), element.properties.end(), is_corner_list);
        if (!is_vertex && !has_corners)
            ignored_.add("elements '" + printable(element.name) + "'", element.count);
        for (std::uint64_t row = 1; row <= element.count; ++row) {
            glm::dvec3 position(0.0);
            for (const PlyProperty& property : element.properties) {
                const int axis = is_vertex ? axis_of(property) : -1;
                if (axis >= 0) {
                    position[axis] = value(*property.type, row);
                    scanner_.require_coordinate(position[axis], {"vertex", row});
                } else if (has_corners && is_corner_list(property)) {
                    is_face ? read_face(property, row) : read_strips(property, row);
                } else {
                    skip(property, row);
                }
            }
            if (is_vertex) polygons_.positions.push_back(position);
            end_row();
        }
        if (is_vertex || has_corners) list_ignored_properties(element);
    }

    void require_room(const PlyElement& element) const {
        std::size_t shortest = 0;
        for (const PlyProperty& property : element.properties) {
            const PlyType& first = property.length_type ? *property.length_type : *property.type;
            shortest += header_.is_binary ? first.size : 2;  // a digit and a separator
        }
        if (shortest > 0) scanner_.require_room({"number of elements"}, element.count, shortest);
        if (shortest == 0 && element.count > 0) scanner_.fail("element", element.name, "has no properties");
    }

    // Some programs wrap long rows of text.
    double value(const PlyType& type, std::uint64_t row) {
        if (header_.is_binary) return type.load(scanner_.bytes(type.size, {"row", row}), header_.is_swapped);
        return scanner_.number({"row", row});
    }

    // Of any type: some write whole numbers as floats.
    std::uint64_t list_length(const PlyProperty& property, std::uint64_t row) {
        const double length = value(*property.length_type, row);
        if (!(length >= 0.0 && length <= 4294967295.0 && length == std::floor(length)))
            scanner_.fail({"length of list", row}, fmt::format("{}", length), "must be a whole number");
        const auto count = static_cast<std::uint64_t>(length);
        scanner_.require_room({"length of list", row}, count, header_.is_binary ? property.type->size : 2);
        return count;
    }

    // A vertex, or -1 if a strip may end here.
    double vertex_index(const PlyType& type, std::uint64_t row, double lowest) {
        const double index = value(type, row);
        if (!(index >= lowest && index < static_cast<double>(vertex_count_) && index == std::floor(index))) {
            scanner_.fail({"face", row}, fmt::format("{}", index),
                          fmt::format("vertex indices must be below {}", vertex_count_));
        }
        return index;
    }

    void read_face(const PlyProperty& property, std::uint64_t row) {
        const std::uint64_t size = list_length(property, row);
        for (std::uint64_t k = 0; k < size; ++k)
            polygons_.corners.push_back(static_cast<std::uint32_t>(vertex_index(*property.type, row, 0.0)));
        polygons_.sizes.push_back(static_cast<std::uint32_t>(size));
    }

    // Each vertex makes a triangle with the two before it, of alternating orientation; -1 begins a new strip.
    void read_strips(const PlyProperty& property, std::uint64_t row) {
        std::array<std::uint32_t, 2> last{};
        std::uint64_t length = 0;  // of the strip so far
        for (std::uint64_t left = list_length(property, row); left > 0; --left) {
            const double index = vertex_index(*property.type, row, -1.0);
            if (index < 0.0) {
                length = 0;
                continue;
            }
            const auto vertex = static_cast<std::uint32_t>(index);
            const bool is_triangle = vertex != last[0] && vertex != last[1] && last[0] != last[1];
            if (length >= 2 && is_triangle) {
                const bool is_even = length % 2 == 0;
                polygons_.corners.insert(polygons_.corners.end(),
                                         {last[is_even ? 0 : 1], last[is_even ? 1 : 0], vertex});
                polygons_.sizes.push_back(3);
            }
            last = {last[1], vertex};
            ++length;
        }
    }

    void skip(const PlyProperty& property, std::uint64_t row) {
        const std::uint64_t count = property.length_type != nullptr ? list_length(property, row) : 1;
        if (header_.is_binary) {
            scanner_.bytes(count * property.type->size, {"row", row});
        } else {
            for (std::uint64_t k = 0; k < count; ++k) value(*property.type, row);
        }
    }

    void end_row() {
        if (header_.is_binary) return;
        if (!scanner_.at_line_end()) ignored_.add("rows' values beyond those of the header");
        scanner_.skip_line();
    }

    void list_ignored_properties(const PlyElement& element) {
        if (element.count == 0) return;
        std::string names;
        for (const PlyProperty& property : element.properties) {
            const bool is_normal = std::find(kNormal.begin(), kNormal.end(), property.name) != kNormal.end();
            const bool is_used = element.name == "vertex" ? axis_of(property) >= 0 : is_corner_list(property);
            if (!is_used && !is_normal) names += (names.empty() ? "" : ", ") + printable(property.name);
        }
        if (!names.empty())
            ignored_.add(fmt::format("properties of element '{}' ({})", element.name, names), element.count);
    }

    void read_end() {
        if (header_.is_binary) {
            ignored_.add("bytes after the last element", scanner_.bytes_left());
        } else {
            for (; !scanner_.at_end(); scanner_.skip_line()) ignored_.add("lines after the last element");
        }
    }

    TextScanner scanner_;
    PlyHeader header_;
    std::uint64_t vertex_count_ = 0;
    Ignored ignored_;
    SurfacePolygons polygons_;
};

}  // namespace

SurfacePolygons read_ply(const std::filesystem::path& file, std::string_view content, Notes& notes) {
    return PlyReader(file, content).read(notes);
}

}  // namespace gelatin
