#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "core/file.h"
#include "mesh/tet_formats.h"
#include "mesh/text_scanner.h"
#include "mesh/volume_cells.h"

namespace gelatin {
namespace {

bool begins_number(std::string_view word) {
    const char c = word.front();
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

std::vector<glm::dvec3> read_vertices(TextScanner& scanner) {
    constexpr std::size_t kShortestRow = 8;  // "0 0 0 0\n"
    const std::size_t count = scanner.count("number of Vertices", kShortestRow);
    std::vector<glm::dvec3> positions;
    positions.reserve(count);
    for (std::uint64_t row = 1; row <= count; ++row) {
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis) position[axis] = scanner.coordinate({"vertex", row});
        scanner.number({"reference of vertex", row});
        positions.push_back(position);
    }
    return positions;
}

struct CellSection {
    const char* keyword;
    CellShape shape;
};

constexpr std::array<CellSection, 4> kCellSections = {{{"Tetrahedra", CellShape::tet},
                                                       {"Hexahedra", CellShape::hexahedron},
                                                       {"Prisms", CellShape::wedge},
                                                       {"Pyramids", CellShape::pyramid}}};

// How many nodes the rows of a section have. Gmsh writes cells of higher order under the usual keywords, with
// at least twice as many nodes as corners, and never with a multiple of the usual length.
std::size_t nodes_in_row(TextScanner ahead, std::size_t corners) {
    std::size_t numbers = 0;
    const auto has_more = [&] { return numbers == 0 ? !ahead.at_end() : !ahead.at_line_end(); };
    while (has_more() && begins_number(ahead.word("row"))) ++numbers;
    const bool is_curved = numbers > 2 * corners && numbers % (corners + 1) != 0;
    return is_curved ? numbers - 1 : corners;
}

void read_cells(TextScanner& scanner, const CellSection& section, VolumeCells& cells) {
    const std::size_t needed = corner_count(section.shape);
    const std::size_t shortest_row = 2 * (needed + 1);  // "1 2 3 4 0\n"
    const std::size_t count =
        scanner.count(("number of " + std::string(section.keyword)).c_str(), shortest_row);
    const std::size_t nodes = nodes_in_row(scanner, needed);
    std::vector<std::uint32_t> corners(nodes);
    for (std::uint64_t row = 1; row <= count; ++row) {
        const FieldName field{section.keyword, row};
        for (std::uint32_t& corner : corners)
            corner = static_cast<std::uint32_t>(scanner.integer(field, 1, cells.positions.size()) - 1);
        cells.add(section.shape, std::span(corners).first(needed), nodes > needed,
                  scanner.signed_integer(field));
    }
}

// Of second order or above, which libMeshb has in versions 3 and 4: TetrahedraP2, HexahedraQ3, ...
bool is_curved_cells(std::string_view keyword) {
    return std::any_of(kCellSections.begin(), kCellSections.end(), [&](const CellSection& section) {
        const std::size_t length = std::string_view(section.keyword).size();
        return keyword.starts_with(section.keyword) && keyword.size() == length + 2;
    });
}

// A section is a keyword, a count, and rows of numbers. Only the format's manual says how many numbers a row
// has.
std::uint64_t skip_section(TextScanner& scanner) {
    const std::uint64_t count = scanner.integer("number of elements");
    for (;;) {
        TextScanner ahead = scanner;
        if (ahead.at_end() || !begins_number(ahead.word("row"))) return count;
        scanner.word("row");
    }
}

}  // namespace

TetMesh read_medit(const std::filesystem::path& file, Notes& notes) {
    const std::string content = read_file(file);
    TextScanner scanner(file, content);
    const std::string_view magic = scanner.word("MeshVersionFormatted");
    if (magic != "MeshVersionFormatted") {
        scanner.fail("header", magic, "must be MeshVersionFormatted: the text form of Medit's files");
    }
    scanner.integer("MeshVersionFormatted", 1, 4);
    VolumeCells cells;
    std::map<std::string, std::uint64_t> skipped;
    while (!scanner.at_end()) {
        const std::string_view keyword = scanner.word("keyword");
        if (keyword == "Dimension") {
            scanner.integer("Dimension", 3, 3);
        } else if (keyword == "Vertices") {
            cells.positions = read_vertices(scanner);
        } else if (keyword == "End") {
            break;
        } else if (begins_number(keyword)) {
            scanner.fail("keyword", keyword, "must be a word such as Vertices, Tetrahedra or End");
        } else if (const auto* section =
                       std::find_if(kCellSections.begin(), kCellSections.end(),
                                    [&](const CellSection& known) { return keyword == known.keyword; });
                   section != kCellSections.end()) {
            read_cells(scanner, *section, cells);
        } else {
            const std::string name(keyword);
            const std::uint64_t count = skip_section(scanner);
            if (is_curved_cells(name))
                cells.add_other(CellShape::unknown, "Medit's " + name, count);
            else if (count > 0)
                skipped[name] += count;
        }
    }
    for (const auto& [kind, count] : skipped) notes.push_back(fmt::format("skipped {}: {}", kind, count));
    return cells.divide(file.string(), notes);
}

}  // namespace gelatin
