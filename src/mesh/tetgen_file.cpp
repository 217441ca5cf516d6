#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/file.h"
#include "mesh/file_ending.h"
#include "mesh/tet_formats.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostAttributes = 1000;

// What the first line may omit at its end.
std::uint64_t optional_integer(TextScanner& scanner, const char* field, std::uint64_t otherwise,
                               std::uint64_t high) {
    return scanner.at_line_end() ? otherwise : scanner.integer(field, 0, high);
}

// Numbers begin with that of the first row, 0 or 1, and increase by one.
struct Nodes {
    std::vector<glm::dvec3> positions;
    std::uint64_t first_number = 0;
};

Nodes read_nodes(const fs::path& file) {
    const std::string content = read_file(file);
    TextScanner scanner(file, content);
    constexpr std::size_t kShortestRow = 8;  // "0 0 0 0\n"
    const std::size_t count = scanner.count("number of nodes", kShortestRow);
    scanner.integer("dimension", 3, 3);
    const std::uint64_t attributes = optional_integer(scanner, "number of attributes", 0, kMostAttributes);
    const std::uint64_t markers = optional_integer(scanner, "number of boundary markers", 0, 1);
    Nodes nodes;
    nodes.positions.reserve(count);
    for (std::uint64_t row = 1; row <= count; ++row) {
        if (row == 1) {
            nodes.first_number = scanner.integer({"number of node", row}, 0, 1);
        } else {
            const std::uint64_t number = nodes.first_number + row - 1;
            scanner.integer({"number of node", row}, number, number);
        }
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis) position[axis] = scanner.coordinate({"node", row});
        nodes.positions.push_back(position);
        for (std::uint64_t k = 0; k < attributes + markers; ++k) scanner.number({"attributes of node", row});
    }
    if (!scanner.at_end())
        scanner.fail("node", scanner.word("node"), "there are more rows than the header says");
    return nodes;
}

// Numbers of regions, which TetGen writes as real numbers.
void keep_whole(const std::vector<double>& attributes, TetMesh& mesh, Notes& notes) {
    constexpr double kMost = 2147483647.0;
    const auto is_whole = [](double a) { return std::abs(a) <= kMost && a == std::round(a); };
    if (std::all_of(attributes.begin(), attributes.end(), is_whole)) {
        for (const double attribute : attributes) mesh.attributes.push_back(static_cast<int>(attribute));
    } else {
        notes.emplace_back("ignored attributes of tets that are not integers");
    }
}

void read_rows_of_tets(const fs::path& file, const Nodes& nodes, TetMesh& mesh, Notes& notes) {
    const std::string content = read_file(file);
    TextScanner scanner(file, content);
    constexpr std::size_t kShortestRow = 10;  // "0 0 1 2 3\n"
    const std::size_t count = scanner.count("number of tets", kShortestRow);
    const std::uint64_t corners = optional_integer(scanner, "nodes of a tet", 4, 10);
    if (corners != 4 && corners != 10)
        scanner.fail("nodes of a tet", fmt::format("{}", corners), "must be 4 or 10");
    const std::uint64_t attributes = optional_integer(scanner, "number of attributes", 0, kMostAttributes);
    if (nodes.positions.empty() && count > 0)
        scanner.fail("number of tets", fmt::format("{}", count), "there are no nodes");
    const std::uint64_t last_number = nodes.first_number + nodes.positions.size() - 1;
    mesh.tets.reserve(count);
    std::vector<double> regions;  // the first attribute of each
    for (std::uint64_t row = 1; row <= count; ++row) {
        scanner.integer({"number of tet", row});
        glm::uvec4 tet;
        for (int corner = 0; corner < 4; ++corner) {
            const std::uint64_t number = scanner.integer({"tet", row}, nodes.first_number, last_number);
            tet[corner] = static_cast<std::uint32_t>(number - nodes.first_number);
        }
        for (std::uint64_t k = 4; k < corners; ++k)
            scanner.integer({"tet", row}, nodes.first_number, last_number);
        for (std::uint64_t k = 0; k < attributes; ++k) {
            const double attribute = scanner.number({"attributes of tet", row});
            if (k == 0) regions.push_back(attribute);
        }
        mesh.tets.push_back(tet);
    }
    if (!scanner.at_end())
        scanner.fail("tet", scanner.word("tet"), "there are more rows than the header says");
    if (corners == 10)
        notes.push_back(fmt::format("kept the corners only of cells with more nodes: {}", count));
    keep_whole(regions, mesh, notes);
}

}  // namespace

TetMesh read_tetgen(const fs::path& file, Notes& notes) {
    const bool named_nodes = lower_case_ending(file) == ".node";
    const fs::path node_file = named_nodes ? file : fs::path(file).replace_extension(".node");
    const fs::path tet_file = named_nodes ? fs::path(file).replace_extension(".ele") : file;
    Nodes nodes = read_nodes(node_file);
    TetMesh mesh;
    read_rows_of_tets(tet_file, nodes, mesh, notes);
    mesh.positions = std::move(nodes.positions);
    return mesh;
}

}  // namespace gelatin
