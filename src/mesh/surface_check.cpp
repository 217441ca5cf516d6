#include "mesh/surface_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <vector>

#include "mesh/load_bytes.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kStlHeader = 84;  // 80 bytes of text, then the number of facets
constexpr std::size_t kStlFacet = 50;   // normal and three vertices in floats, then 2 bytes

void check_text_stl(const fs::path& file, std::string_view content) {
    TextScanner scanner(file, content, 0);
    std::uint64_t facet = 0;
    while (!scanner.at_end()) {
        scanner.expect("solid");
        scanner.skip_line();  // its name
        for (;;) {
            const std::string_view word = scanner.word("endsolid");
            if (word == "endsolid") break;
            if (word != "facet") scanner.fail("word", word, "must be 'facet' or 'endsolid' here");
            ++facet;
            scanner.expect("normal");
            for (int axis = 0; axis < 3; ++axis) scanner.number({"normal of facet", facet});
            scanner.expect("outer");
            scanner.expect("loop");
            for (int corner = 0; corner < 3; ++corner) {
                scanner.expect("vertex");
                for (int axis = 0; axis < 3; ++axis) scanner.coordinate({"vertex of facet", facet});
            }
            scanner.expect("endloop");
            scanner.expect("endfacet");
        }
        scanner.skip_line();
    }
}

void check_binary_stl(const fs::path& file, std::string_view facets) {
    TextScanner scanner(file, facets);
    for (std::uint64_t facet = 1; facet <= facets.size() / kStlFacet; ++facet) {
        const std::string_view bytes = scanner.bytes(kStlFacet, "facet");
        for (std::size_t value = 3; value < 12; ++value) {
            const float coordinate = load_bytes<float>(bytes, 4 * value, kLittleIsSwapped);
            scanner.require_coordinate(coordinate, {"vertex of facet", facet});
        }
    }
}

std::uint64_t read_off_counts(TextScanner& scanner, std::uint64_t& face_count) {
    std::string_view kind = scanner.word("OFF header");
    const std::string_view whole = kind;
    for (const std::string_view prefix : {"ST", "C", "N"}) {
        if (kind.starts_with(prefix)) kind.remove_prefix(prefix.size());
    }
    if (kind != "OFF") scanner.fail("header", whole, "must be OFF, COFF, NOFF or STOFF, in text");
    constexpr std::size_t kShortestVertex = 6, kShortestFace = 2;  // "0 0 0\n", "0\n"
    const std::uint64_t vertex_count = scanner.count("number of vertices", kShortestVertex);
    face_count = scanner.count("number of faces", kShortestFace);
    if (scanner.at_line_end()) scanner.fail("number of edges", {}, "must follow the number of faces");
    scanner.integer("number of edges");
    return vertex_count;
}

// Returns the number of vertices.
std::size_t check_obj_vertices(const fs::path& file, std::string_view content) {
    std::size_t count = 0;
    for (TextScanner scanner(file, content); !scanner.at_end(); scanner.skip_line()) {
        if (scanner.word("keyword") != "v") continue;
        ++count;
        for (int axis = 0; axis < 3; ++axis) {
            if (scanner.at_line_end()) scanner.fail({"vertex", count}, {}, "must have three coordinates");
            scanner.coordinate({"vertex", count});
        }
    }
    return count;
}

// Index of the vertex of "12", "12/3", "12//4" or "-1".
std::size_t obj_vertex(const TextScanner& scanner, std::string_view corner, std::size_t count,
                       std::size_t total) {
    long long number = 0;
    const char* const end = corner.data() + corner.size();
    const auto [stop, error] = std::from_chars(corner.data(), end, number);
    const long long index = number < 0 ? static_cast<long long>(count) + number : number - 1;
    const bool is_number = error == std::errc() && number != 0 && (stop == end || *stop == '/');
    if (!is_number || index < 0 || index >= static_cast<long long>(total)) {
        scanner.fail(
            "face", corner,
            fmt::format("must name a vertex by its number from 1 to {}, or count back from the last by a "
                        "negative one",
                        total));
    }
    return static_cast<std::size_t>(index);
}

}  // namespace

ObjVertices check_obj(const fs::path& file, std::string_view content) {
    const std::size_t total = check_obj_vertices(file, content);
    std::vector<bool> used(total, false);
    std::size_t count = 0;  // so far: negative numbers count back from here
    for (TextScanner scanner(file, content); !scanner.at_end(); scanner.skip_line()) {
        const std::string_view keyword = scanner.word("keyword");
        if (keyword == "v") ++count;
        if (keyword != "f") continue;
        while (!scanner.at_line_end()) {
            const std::string_view corner = scanner.word("face");
            if (corner == "\\") {  // continues on the next line
                scanner.skip_line();
            } else {
                used[obj_vertex(scanner, corner, count, total)] = true;
            }
        }
    }
    return {total, static_cast<std::size_t>(std::count(used.begin(), used.end(), true))};
}

void check_off(const fs::path& file, std::string_view content) {
    TextScanner scanner(file, content);
    std::uint64_t face_count = 0;
    const std::uint64_t vertex_count = read_off_counts(scanner, face_count);
    scanner.skip_line();
    for (std::uint64_t vertex = 1; vertex <= vertex_count; ++vertex) {
        for (int axis = 0; axis < 3; ++axis) {
            if (axis > 0 && scanner.at_line_end())
                scanner.fail({"vertex", vertex}, {}, "must have three coordinates");
            scanner.coordinate({"vertex", vertex});
        }
        scanner.skip_line();
    }
    for (std::uint64_t face = 1; face <= face_count; ++face) {
        constexpr std::uint64_t kMostCorners = 9;  // Assimp silently discards larger faces
        const std::uint64_t corners = scanner.integer({"corners of face", face}, 1, kMostCorners);
        for (std::uint64_t corner = 0; corner < corners; ++corner) {
            if (scanner.at_line_end()) {
                scanner.fail({"face", face}, {}, fmt::format("must have {} vertices on its line", corners));
            }
            if (vertex_count == 0) scanner.fail("number of vertices", "0", "must be positive");
            scanner.integer({"face", face}, 0, vertex_count - 1);
        }
        scanner.skip_line();
    }
}

std::size_t binary_stl_size(const fs::path& file, std::string_view content) {
    const bool has_count = content.size() >= kStlHeader;
    const std::uint64_t facets = has_count ? load_bytes<std::uint32_t>(content, 80, kLittleIsSwapped) : 0;
    const std::uint64_t size = kStlHeader + kStlFacet * facets;
    // Some programs begin the header of binary files with 'solid' too; then the size decides.
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    const bool may_be_text = first != std::string_view::npos && content.substr(first).starts_with("solid");
    if (may_be_text && size != content.size()) return 0;
    TextScanner scanner(file, content);
    if (!has_count) scanner.fail_cut_off("header of 84 bytes");
    scanner.bytes(kStlHeader, "header");
    if (size > content.size()) scanner.require_room("number of facets", facets, kStlFacet);
    return static_cast<std::size_t>(size);
}

void check_stl(const fs::path& file, std::string_view content) {
    const std::size_t size = binary_stl_size(file, content);
    if (size == 0) {
        check_text_stl(file, content);
    } else {
        check_binary_stl(file, content.substr(kStlHeader, size - kStlHeader));
    }
}

}  // namespace gelatin
