#include <fmt/core.h>

#include <cstdint>
#include <map>

#include "core/file.h"
#include "mesh/tet_formats.h"
#include "mesh/text_scanner.h"

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

void read_tetrahedra(TextScanner& scanner, TetMesh& mesh) {
    constexpr std::size_t kShortestRow = 10;  // "1 2 3 4 0\n"
    const std::size_t count = scanner.count("number of Tetrahedra", kShortestRow);
    const std::size_t node_count = mesh.positions.size();
    mesh.tets.reserve(count);
    for (std::uint64_t row = 1; row <= count; ++row) {
        glm::uvec4 tet;
        for (int corner = 0; corner < 4; ++corner) {
            tet[corner] =
                static_cast<std::uint32_t>(scanner.integer({"tetrahedron", row}, 1, node_count) - 1);
        }
        mesh.attributes.push_back(scanner.signed_integer({"reference of tetrahedron", row}));
        mesh.tets.push_back(tet);
    }
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
    TetMesh mesh;
    std::map<std::string, std::uint64_t> skipped;
    while (!scanner.at_end()) {
        const std::string_view keyword = scanner.word("keyword");
        if (keyword == "Dimension") {
            scanner.integer("Dimension", 3, 3);
        } else if (keyword == "Vertices") {
            mesh.positions = read_vertices(scanner);
        } else if (keyword == "Tetrahedra") {
            read_tetrahedra(scanner, mesh);
        } else if (keyword == "End") {
            break;
        } else if (begins_number(keyword)) {
            scanner.fail("keyword", keyword, "must be a word such as Vertices, Tetrahedra or End");
        } else {
            const std::uint64_t count = skip_section(scanner);
            if (count > 0) skipped[std::string(keyword)] += count;
        }
    }
    for (const auto& [kind, count] : skipped) notes.push_back(fmt::format("skipped {}: {}", kind, count));
    return mesh;
}

}  // namespace gelatin
