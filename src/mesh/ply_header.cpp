#include "mesh/ply_header.h"

#include <array>

#include "mesh/load_bytes.h"

namespace gelatin {
namespace {

template <class T>
double load_as_double(std::string_view bytes, bool swapped) {
    return static_cast<double>(load_bytes<T>(bytes, 0, swapped));
}

constexpr std::array<PlyType, 8> kTypes = {{
    {"char", "int8", 1, load_as_double<std::int8_t>},
    {"uchar", "uint8", 1, load_as_double<std::uint8_t>},
    {"short", "int16", 2, load_as_double<std::int16_t>},
    {"ushort", "uint16", 2, load_as_double<std::uint16_t>},
    {"int", "int32", 4, load_as_double<std::int32_t>},
    {"uint", "uint32", 4, load_as_double<std::uint32_t>},
    {"float", "float32", 4, load_as_double<float>},
    {"double", "float64", 8, load_as_double<double>},
}};

// A word of the header, in small letters. What belongs together is on one line.
std::string header_word(TextScanner& scanner, const char* field) {
    if (scanner.at_line_end()) scanner.fail(field, {}, "is missing");
    return lower_case(scanner.word(field));
}

const PlyType& find_type(const TextScanner& scanner, const std::string& word) {
    for (const PlyType& type : kTypes) {
        if (word == type.name || word == type.other_name) return type;
    }
    scanner.fail("type of property", word,
                 "must be one of char, uchar, short, ushort, int, uint, float, double");
}

PlyProperty read_property(TextScanner& scanner) {
    PlyProperty property;
    std::string word = header_word(scanner, "type of property");
    if (word == "list") {
        property.length_type = &find_type(scanner, header_word(scanner, "type of list length"));
        word = header_word(scanner, "type of property");
    }
    property.type = &find_type(scanner, word);
    property.name = header_word(scanner, "name of property");
    return property;
}

void read_format(TextScanner& scanner, PlyHeader& header) {
    const std::string format = header_word(scanner, "format");
    header.is_binary = format != "ascii";
    header.is_swapped = (format == "binary_big_endian") != kLittleIsSwapped;
    if (header.is_binary && format != "binary_little_endian" && format != "binary_big_endian")
        scanner.fail("format", format, "must be ascii, binary_little_endian or binary_big_endian");
}

}  // namespace

PlyHeader read_ply_header(TextScanner& scanner) {
    PlyHeader header;
    const std::string_view magic = scanner.word("'ply'");
    if (lower_case(magic) != "ply") scanner.fail("header", magic, "must begin with 'ply'");
    bool has_format = false;
    for (scanner.skip_line();; scanner.skip_line()) {
        const std::string keyword = lower_case(scanner.word("'end_header'"));
        if (keyword == "format") {
            read_format(scanner, header);
            has_format = true;
        } else if (keyword == "element") {
            const std::string name = header_word(scanner, "name of element");
            if (scanner.at_line_end()) scanner.fail("number of elements", {}, "is missing");
            header.elements.push_back({name, scanner.integer({"number of elements"}), {}});
        } else if (keyword == "property") {
            if (header.elements.empty()) scanner.fail("property", {}, "must follow an element");
            header.elements.back().properties.push_back(read_property(scanner));
        } else if (keyword == "end_header") {
            if (!has_format) scanner.fail("format", {}, "is missing");
            scanner.skip_line();
            return header;
        } else if (keyword == "comment" || keyword == "obj_info") {
            continue;
        } else if (header.elements.empty()) {
            ++header.ignored_lines;  // comments without their keyword, as of Blender 2.4
        } else {
            scanner.fail("keyword", keyword,
                         "must be format, element, property, comment, obj_info or end_header");
        }
    }
}

}  // namespace gelatin
