#include <fmt/core.h>

#include <cstdint>
#include <string>

#include "mesh/ignored.h"
#include "mesh/load_bytes.h"
#include "mesh/surface_readers.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeader = 84;  // 80 bytes of text, then the number of facets
constexpr std::size_t kFacet = 50;   // normal and three vertices in floats, then 2 bytes

std::uint64_t binary_size(std::string_view content) {
    return kHeader + kFacet * std::uint64_t{load_bytes<std::uint32_t>(content, 80, kLittleIsSwapped)};
}

class TextStl {
public:
    TextStl(const fs::path& file, std::string_view content) : scanner_(file, content, 0) {}

    SurfacePolygons read(Notes& notes) {
        bool is_open = false;  // a solid
        while (!scanner_.at_end()) {
            const std::string_view word = scanner_.word("word");
            const std::string keyword = lower_case(word);
            if (keyword == "facet") {
                read_facet();
            } else if (keyword == "solid" || keyword == "endsolid") {
                is_open = keyword == "solid";
                scanner_.skip_line();  // its name
            } else if (keyword == "color" || keyword == "colour") {
                ignored_.add("colours");
                scanner_.skip_line();
            } else {
                scanner_.fail("word", word, "must be 'facet', 'solid' or 'endsolid' here");
            }
        }
        if (is_open) scanner_.fail_cut_off("endsolid");
        ignored_.report(notes);
        return std::move(polygons_);
    }

private:
    void expect(const char* expected) {
        const std::string_view found = scanner_.word(expected);
        if (lower_case(found) != expected)
            scanner_.fail("word", found, fmt::format("must be '{}' here", expected));
    }

    void read_facet() {
        const std::uint64_t facet = polygons_.sizes.size() + 1;
        expect("normal");
        for (int axis = 0; axis < 3; ++axis) scanner_.word({"normal of facet", facet});  // some write nan
        expect("outer");
        expect("loop");
        std::uint32_t size = 0;
        for (;; ++size) {
            const std::string_view word = scanner_.word("endloop");
            const std::string keyword = lower_case(word);
            if (keyword == "endloop" && size >= 3) break;
            if (keyword != "vertex") scanner_.fail("word", word, "must be 'vertex' here");
            glm::dvec3 position;
            for (int axis = 0; axis < 3; ++axis)
                position[axis] = scanner_.coordinate({"vertex of facet", facet});
            polygons_.corners.push_back(static_cast<std::uint32_t>(polygons_.positions.size()));
            polygons_.positions.push_back(position);
        }
        expect("endfacet");
        polygons_.sizes.push_back(size);
    }

    TextScanner scanner_;
    Ignored ignored_;
    SurfacePolygons polygons_;
};

SurfacePolygons read_binary(const fs::path& file, std::string_view content, Notes& notes) {
    TextScanner scanner(file, content, 0);
    scanner.bytes(kHeader, "header of 84 bytes");
    const std::uint64_t facets = (binary_size(content) - kHeader) / kFacet;
    scanner.require_room("number of facets", facets, kFacet);
    SurfacePolygons polygons;
    polygons.positions.reserve(3 * facets);
    polygons.corners.reserve(3 * facets);
    polygons.sizes.assign(facets, 3);
    std::size_t attributes = 0;
    for (std::uint64_t facet = 1; facet <= facets; ++facet) {
        const std::string_view bytes = scanner.bytes(kFacet, {"facet", facet});
        for (std::size_t value = 3; value < 12; value += 3) {
            glm::dvec3 position;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float coordinate = load_bytes<float>(bytes, 4 * (value + axis), kLittleIsSwapped);
                scanner.require_coordinate(coordinate, {"vertex of facet", facet});
                position[static_cast<int>(axis)] = coordinate;
            }
            polygons.corners.push_back(static_cast<std::uint32_t>(polygons.positions.size()));
            polygons.positions.push_back(position);
        }
        if (load_bytes<std::uint16_t>(bytes, kFacet - 2, false) != 0) ++attributes;
    }
    Ignored ignored;
    ignored.add("attributes of facets, which some programs use for colours", attributes);
    ignored.add("bytes after the last facet", content.size() - binary_size(content));
    ignored.report(notes);
    return polygons;
}

// Some programs begin the header of binary files with 'solid', too. But their number of facets has a byte of
// zero, unless there are 16 million.
bool is_text(const fs::path& file, std::string_view content) {
    TextScanner scanner(file, content, 0);
    if (scanner.at_end()) return false;
    const std::string word = lower_case(scanner.word("word"));
    return (word == "solid" || word == "facet") &&
           content.substr(0, kHeader).find('\0') == std::string_view::npos;
}

bool has_binary_size(std::string_view content) {
    return content.size() >= kHeader && binary_size(content) == content.size();
}

}  // namespace

bool seems_stl(const fs::path& file, std::string_view content) {
    return (has_binary_size(content) && content.size() > kHeader) || is_text(file, content);
}

SurfacePolygons read_stl(const fs::path& file, std::string_view content, Notes& notes) {
    if (!has_binary_size(content) && is_text(file, content)) return TextStl(file, content).read(notes);
    return read_binary(file, content, notes);
}

}  // namespace gelatin
