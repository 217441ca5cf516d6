#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/load_bytes.h"
#include "mesh/surface_check.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

struct ScalarType {
    std::string_view name, other_name;
    std::size_t size;
    double (*load)(std::string_view bytes, bool swapped);
};

template <class T>
double load_as_double(std::string_view bytes, bool swapped) {
    return static_cast<double>(load_bytes<T>(bytes, 0, swapped));
}

constexpr std::array<ScalarType, 8> kScalarTypes = {{
    {"char", "int8", 1, load_as_double<std::int8_t>},
    {"uchar", "uint8", 1, load_as_double<std::uint8_t>},
    {"short", "int16", 2, load_as_double<std::int16_t>},
    {"ushort", "uint16", 2, load_as_double<std::uint16_t>},
    {"int", "int32", 4, load_as_double<std::int32_t>},
    {"uint", "uint32", 4, load_as_double<std::uint32_t>},
    {"float", "float32", 4, load_as_double<float>},
    {"double", "float64", 8, load_as_double<double>},
}};

struct Property {
    std::string_view name;
    const ScalarType* type = nullptr;
    const ScalarType* length_type = nullptr;  // of a list, else none

    bool is_coordinate() const { return name == "x" || name == "y" || name == "z"; }
    bool is_vertex_list() const { return name == "vertex_indices" || name == "vertex_index"; }
};

struct Element {
    std::string_view name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    bool binary = false, swapped = false;
    std::vector<Element> elements;
};

// A word of the header. What belongs together is on one line.
std::string_view header_word(TextScanner& scanner, const char* field) {
    if (scanner.at_line_end()) scanner.fail(field, {}, "is missing");
    return scanner.word(field);
}

const ScalarType& find_type(const TextScanner& scanner, std::string_view word) {
    for (const ScalarType& type : kScalarTypes) {
        if (word == type.name || word == type.other_name) return type;
    }
    scanner.fail("type of property", word,
                 "must be one of char, uchar, short, ushort, int, uint, float, double");
}

Property read_property(TextScanner& scanner) {
    Property property;
    std::string_view word = header_word(scanner, "type of property");
    if (word == "list") {
        property.length_type = &find_type(scanner, header_word(scanner, "type of list length"));
        word = header_word(scanner, "type of property");
    }
    property.type = &find_type(scanner, word);
    property.name = header_word(scanner, "name of property");
    return property;
}

Header read_header(TextScanner& scanner) {
    Header header;
    const std::string_view magic = scanner.word("'ply'");
    if (magic != "ply" && magic != "PLY") scanner.fail("header", magic, "must begin with 'ply'");
    scanner.skip_line();
    for (;; scanner.skip_line()) {
        const std::string_view keyword = scanner.word("'end_header'");
        if (keyword == "format") {
            const std::string_view format = header_word(scanner, "format");
            header.binary = format != "ascii";
            header.swapped = (format == "binary_big_endian") != kLittleIsSwapped;
            if (header.binary && format != "binary_little_endian" && format != "binary_big_endian") {
                scanner.fail("format", format, "must be ascii, binary_little_endian or binary_big_endian");
            }
        } else if (keyword == "element") {
            const std::string_view name = header_word(scanner, "name of element");
            if (scanner.at_line_end()) scanner.fail("number of elements", {}, "is missing");
            header.elements.push_back({name, scanner.integer({"number of elements"}), {}});
        } else if (keyword == "property") {
            if (header.elements.empty()) scanner.fail("property", {}, "must follow an element");
            header.elements.back().properties.push_back(read_property(scanner));
        } else if (keyword == "end_header") {
            return header;
        } else if (keyword != "comment" && keyword != "obj_info") {
            scanner.fail("keyword", keyword,
                         "must be format, element, property, comment, obj_info or end_header");
        }
    }
}

// Scans the rows of one element.
class Rows {
public:
    Rows(TextScanner& scanner, const Header& header, const Element& element, std::uint64_t vertex_count)
        : scanner_(scanner), header_(header), element_(element), vertex_count_(vertex_count) {}

    void check() {
        require_room();
        for (std::uint64_t row = 1; row <= element_.count; ++row) {
            for (const Property& property : element_.properties) check_property(property, row);
            if (!header_.binary) scanner_.skip_line();
        }
    }

private:
    void require_room() const {
        std::size_t shortest = 0;
        for (const Property& property : element_.properties) {
            const ScalarType& first = property.length_type ? *property.length_type : *property.type;
            shortest += header_.binary ? first.size : 2;  // a digit and a separator
        }
        if (shortest > 0) scanner_.require_room({"number of elements"}, element_.count, shortest);
        if (shortest == 0 && element_.count > 0) scanner_.fail("element", element_.name, "has no properties");
    }

    void check_property(const Property& property, std::uint64_t row) {
        const bool is_face = element_.name == "face" && property.is_vertex_list();
        if (property.length_type == nullptr) {
            const double value = read(*property.type, row);
            if (element_.name == "vertex" && property.is_coordinate()) {
                scanner_.require_coordinate(value, {"vertex", row});
            }
            return;
        }
        const double length = read(*property.length_type, row);
        if (!(length >= 0.0))
            scanner_.fail({"length of list", row}, fmt::format("{}", length), "must not be negative");
        for (double k = 0.0; k < length; k += 1.0) {
            const double value = read(*property.type, row);
            if (is_face && !(value >= 0.0 && value < static_cast<double>(vertex_count_))) {
                scanner_.fail({"face", row}, fmt::format("{}", value),
                              fmt::format("vertex indices must be below {}", vertex_count_));
            }
        }
    }

    double read(const ScalarType& type, std::uint64_t row) {
        if (header_.binary) return type.load(scanner_.bytes(type.size, {"row", row}), header_.swapped);
        if (scanner_.at_line_end())
            scanner_.fail({"row", row}, {}, "is too short, or the file is cut off here");
        return scanner_.number({"row", row});
    }

    TextScanner& scanner_;
    const Header& header_;
    const Element& element_;
    std::uint64_t vertex_count_;
};

}  // namespace

void check_ply(const std::filesystem::path& file, std::string_view content) {
    TextScanner scanner(file, content, 0);
    const Header header = read_header(scanner);
    scanner.skip_line();
    const auto vertices = std::find_if(header.elements.begin(), header.elements.end(),
                                       [](const Element& element) { return element.name == "vertex"; });
    if (vertices == header.elements.end()) scanner.fail("element vertex", {}, "is missing");
    const auto coordinates = std::count_if(
        vertices->properties.begin(), vertices->properties.end(),
        [](const Property& property) { return property.is_coordinate() && property.length_type == nullptr; });
    if (coordinates != 3) scanner.fail("element vertex", {}, "must have the properties x, y and z");
    for (const Element& element : header.elements) Rows(scanner, header, element, vertices->count).check();
}

}  // namespace gelatin
