#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>

#include "mesh/ignored.h"
#include "mesh/surface_readers.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

class OffReader {
public:
    OffReader(const std::filesystem::path& file, std::string_view content) : scanner_(file, content) {}

    SurfacePolygons read(Notes& notes) {
        read_header();
        for (std::size_t vertex = 1; vertex <= vertex_count_; ++vertex) read_vertex(vertex);
        for (std::size_t face = 1; face <= face_count_; ++face) read_face(face);
        for (; !scanner_.at_end(); scanner_.skip_line()) ignored_.add("lines after the last face");
        ignored_.report(notes);
        return std::move(polygons_);
    }

private:
    static constexpr std::size_t kShortestVertex = 6, kShortestFace = 2;  // "0 0 0\n", "0\n"

    // The keyword, which may be left out; then the numbers of vertices, faces and edges, the last of which
    // nobody uses and some leave out.
    void read_header() {
        read_keyword();
        vertex_count_ = scanner_.count("number of vertices", kShortestVertex);
        const bool is_one_line = !scanner_.at_line_end();
        face_count_ = scanner_.count("number of faces", kShortestFace);
        if (!is_one_line || !scanner_.at_line_end()) scanner_.integer("number of edges");
        scanner_.skip_line();
    }

    // Files of ModelNet lack the blank between the keyword and the number of vertices.
    void read_keyword() {
        TextScanner ahead = scanner_;
        const std::string_view word = ahead.word("OFF header");
        const std::string keyword = lower_case(word);
        const std::size_t off = std::min(keyword.find("off"), keyword.size());
        const std::string behind = off < keyword.size() ? keyword.substr(off + 3) : keyword;
        const std::string prefix = off < keyword.size() ? keyword.substr(0, off) : "";
        constexpr std::array kPrefixes = {"", "c", "n", "cn", "nc", "st", "stc", "stn", "stcn", "stnc"};
        const bool is_known = std::find(kPrefixes.begin(), kPrefixes.end(), prefix) != kPrefixes.end();
        const bool is_n_dimensional = word.find("nOFF") != std::string_view::npos;  // NOFF has normals
        if (!is_known || is_n_dimensional || behind.find_first_not_of("0123456789") != std::string::npos)
            scanner_.fail("header", word, "must be OFF, COFF, NOFF or STOFF, in text");
        if (behind.empty() && !ahead.at_line_end() && lower_case(ahead.word("word")) == "binary")
            scanner_.fail("header", "OFF BINARY", "only OFF files in text are read");
        has_colors_ = prefix.find('c') != std::string::npos;
        has_values_ = !prefix.empty();
        scanner_.skip_over(word.substr(0, word.size() - behind.size()));
    }

    void read_vertex(std::size_t vertex) {
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis) {
            if (axis > 0 && scanner_.at_line_end())
                scanner_.fail({"vertex", vertex}, {}, "must have three coordinates");
            position[axis] = scanner_.coordinate({"vertex", vertex});
        }
        polygons_.positions.push_back(position);
        if (!scanner_.at_line_end()) {
            if (has_colors_) ignored_.add("colours of vertices");
            if (!has_values_) ignored_.add("values after the coordinates of vertices");
        }
        scanner_.skip_line();
    }

    // Some programs wrap long lines.
    void read_face(std::size_t face) {
        const std::uint64_t size = scanner_.integer({"corners of face", face}, 0, ~std::uint32_t{0});
        for (std::uint64_t corner = 0; corner < size; ++corner) {
            if (vertex_count_ == 0) scanner_.fail("number of vertices", "0", "must be positive");
            polygons_.corners.push_back(
                static_cast<std::uint32_t>(scanner_.integer({"face", face}, 0, vertex_count_ - 1)));
        }
        polygons_.sizes.push_back(static_cast<std::uint32_t>(size));
        if (!scanner_.at_line_end()) ignored_.add("colours of faces");
        scanner_.skip_line();
    }

    TextScanner scanner_;
    Ignored ignored_;
    SurfacePolygons polygons_;
    std::size_t vertex_count_ = 0, face_count_ = 0;
    bool has_colors_ = false, has_values_ = false;  // behind the coordinates of a vertex, as the header says
};

}  // namespace

SurfacePolygons read_off(const std::filesystem::path& file, std::string_view content, Notes& notes) {
    return OffReader(file, content).read(notes);
}

}  // namespace gelatin
