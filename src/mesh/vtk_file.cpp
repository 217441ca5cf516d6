// VTK's legacy format: "VTK File Formats", www.vtk.org; version 5 in vtkUnstructuredGridWriter.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "core/counted.h"
#include "core/file.h"
#include "mesh/load_bytes.h"
#include "mesh/tet_formats.h"
#include "mesh/text_scanner.h"
#include "mesh/vtk_grid.h"

namespace gelatin {
namespace {

constexpr std::uint64_t kMostComponents = 1 << 20;

class VtkReader {
public:
    VtkReader(const std::filesystem::path& file, std::string_view content)
        : file_(file), scanner_(file, content, 0) {}

    TetMesh read(Notes& notes) {
        read_header();
        bool has_points = false, has_cells = false, has_types = false;
        while (!has_points || !has_cells || !has_types) {
            const std::string keyword = read_keyword("section");
            if (keyword == "points") {
                read_points();
                has_points = true;
            } else if (keyword == "cells") {
                is_version_5_ ? read_cells_5() : read_cells();
                has_cells = true;
            } else if (keyword == "cell_types") {
                const std::size_t count = scanner_.count("number of cell types", is_binary_ ? 4 : 2);
                grid_.types = read_integers(kInt, count, "type of cell");
                has_types = true;
            } else if (!skip_other(keyword)) {
                scanner_.fail("section", keyword, "must be POINTS, CELLS or CELL_TYPES");
            }
        }
        read_data(notes);
        VtkCells cells(file_);
        cells.add(grid_, 0);
        return cells.finish(notes);
    }

private:
    static constexpr VtkType kInt = {VtkType::Kind::signed_integer, 4};

    void read_header() {
        for (const char* word : {"#", "vtk", "DataFile", "Version"}) scanner_.expect(word);
        const std::string_view version = scanner_.word("version");
        const bool is_known =
            version.size() >= 3 && version[0] >= '1' && version[0] <= '5' && version[1] == '.';
        if (!is_known) scanner_.fail("version", version, "must be from 1.0 to 5.1");
        is_version_5_ = version[0] == '5';
        scanner_.skip_line();
        scanner_.skip_line();  // the title
        const std::string coding = read_keyword("coding");
        if (coding != "ascii" && coding != "binary")
            scanner_.fail("coding", coding, "must be ASCII or BINARY");
        is_binary_ = coding == "binary";
        if (const std::string word = read_keyword("DATASET"); word != "dataset")
            scanner_.fail("word", word, "must be 'DATASET' here");
        const std::string kind = read_keyword("DATASET");
        if (kind != "unstructured_grid") scanner_.fail("DATASET", kind, "must be UNSTRUCTURED_GRID");
    }

    // VTK does not distinguish upper and lower case.
    std::string read_keyword(const FieldName& field) {
        std::string word(scanner_.word(field));
        for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return word;
    }

    VtkType read_type(const FieldName& field) {
        const std::string_view name = scanner_.word(field);
        const std::optional<VtkType> type = find_vtk_type(name);
        if (!type) scanner_.fail(field, name, "must be a type of numbers, such as int or double");
        return *type;
    }

    // The rest of the line belongs to what announces the numbers.
    std::string_view read_bytes(VtkType type, std::uint64_t count, const char* field) {
        scanner_.require_room(field, count, type.size);
        scanner_.skip_line();
        return scanner_.bytes(count * type.size, field);
    }

    std::vector<std::int64_t> read_integers(VtkType type, std::uint64_t count, const char* field) {
        if (!type.is_integer()) scanner_.fail(field, {}, "must be integers");
        std::vector<std::int64_t> numbers;
        if (is_binary_) {
            const std::string_view bytes = read_bytes(type, count, field);
            numbers.reserve(count);
            for (std::size_t k = 0; k < count; ++k)
                numbers.push_back(
                    load_vtk_number<std::int64_t>(type, bytes, k * type.size, !kLittleIsSwapped));
            return numbers;
        }
        scanner_.require_room(field, count, 2);
        numbers.reserve(count);
        for (std::uint64_t k = 1; k <= count; ++k) numbers.push_back(scanner_.large_integer({field, k}));
        return numbers;
    }

    void skip_numbers(VtkType type, std::uint64_t count, const char* field) {
        if (is_binary_) {
            read_bytes(type, count, field);
            return;
        }
        scanner_.require_room(field, count, 2);
        for (std::uint64_t k = 0; k < count; ++k) scanner_.word(field);
    }

    void read_points() {
        const std::size_t count = scanner_.count("number of points", 3);
        const VtkType type = read_type("type of points");
        std::string_view bytes;
        if (is_binary_) bytes = read_bytes(type, 3 * std::uint64_t{count}, "number of points");
        grid_.points.resize(count);
        for (std::size_t p = 0; p < count; ++p) {
            for (int axis = 0; axis < 3; ++axis) {
                double& value = grid_.points[p][axis];
                if (is_binary_) {
                    const std::size_t offset = (3 * p + static_cast<std::size_t>(axis)) * type.size;
                    value = load_vtk_number<double>(type, bytes, offset, !kLittleIsSwapped);
                    scanner_.require_coordinate(value, {"point", p + 1});
                } else {
                    value = scanner_.coordinate({"point", p + 1});
                }
            }
        }
    }

    // Each cell is the number of its points, and these.
    void read_cells() {
        const std::size_t count = scanner_.count("number of cells", is_binary_ ? 4 : 2);
        const std::size_t size = scanner_.count("size of cells", is_binary_ ? 4 : 2);
        const std::vector<std::int64_t> numbers = read_integers(kInt, size, "number of cells");
        std::size_t at = 0;
        for (std::size_t c = 1; c <= count; ++c) {
            const std::size_t left = size - at;
            if (left == 0 || numbers[at] < 0 || numbers[at] > static_cast<std::int64_t>(left - 1)) {
                scanner_.fail({"cell", c}, left == 0 ? "" : counted(numbers[at], "point"),
                              fmt::format("CELLS has only {} numbers", size));
            }
            const auto points = static_cast<std::size_t>(numbers[at]);
            const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(at + 1);
            grid_.connectivity.insert(grid_.connectivity.end(), begin,
                                      begin + static_cast<std::ptrdiff_t>(points));
            grid_.ends.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
            at += 1 + points;
        }
        if (at != size) {
            scanner_.fail("size of cells", fmt::format("{}", size),
                          fmt::format("but {} have {}", counted(count, "cell"), counted(at, "number")));
        }
    }

    // First where each cell begins, and where the last one ends; then all points.
    void read_cells_5() {
        const std::uint64_t offsets = scanner_.integer("number of offsets");
        const std::uint64_t points = scanner_.integer("size of cells");
        scanner_.expect("OFFSETS");
        grid_.ends = read_integers(read_type("type of OFFSETS"), offsets, "offset");
        if (!grid_.ends.empty()) {
            if (grid_.ends[0] != 0) scanner_.fail("offset 1", fmt::format("{}", grid_.ends[0]), "must be 0");
            grid_.ends.erase(grid_.ends.begin());
        }
        scanner_.expect("CONNECTIVITY");
        grid_.connectivity = read_integers(read_type("type of CONNECTIVITY"), points, "point of cells");
    }

    // What may stand between the parts of the grid.
    bool skip_other(const std::string& keyword) {
        if (keyword == "metadata") {
            skip_metadata();
            return true;
        }
        return keyword == "field" && read_field().empty();
    }

    // It ends with an empty line.
    void skip_metadata() {
        do scanner_.skip_line();
        while (!scanner_.at_line_end());
    }

    // Data of cells and points, up to the first thing that is not known: the grid is complete without it.
    void read_data(Notes& notes) {
        while (!scanner_.at_end()) {
            const std::string keyword = read_keyword("section");
            std::string unknown;
            if (keyword == "cell_data" || keyword == "point_data") {
                is_of_cells_ = keyword == "cell_data";
                tuples_ = scanner_.integer("number of data");
                if (is_of_cells_ && tuples_ != grid_.types.size()) {
                    scanner_.fail("CELL_DATA", fmt::format("{}", tuples_),
                                  fmt::format("must be the number of cells, {}", grid_.types.size()));
                }
            } else if (keyword == "metadata") {
                skip_metadata();
            } else if (keyword == "field") {
                unknown = read_field();
            } else {
                unknown = read_attribute(keyword);
            }
            if (unknown.empty()) continue;
            notes.push_back(fmt::format("ignored the data from '{}' on, which Gelatin does not know",
                                        unknown.substr(0, 40)));
            return;
        }
    }

    // These functions return the first word that they do not know; empty if there is none.

    std::string read_field() {
        scanner_.word("name of field");
        const std::uint64_t arrays = scanner_.integer("number of arrays");
        for (std::uint64_t k = 0; k < arrays;) {
            const std::string name(scanner_.word({"array", k + 1}));
            if (name == "METADATA") {
                skip_metadata();
                continue;
            }
            const std::uint64_t components =
                scanner_.integer({"components of array", k + 1}, 0, kMostComponents);
            const std::uint64_t tuples = scanner_.integer({"length of array", k + 1});
            scanner_.require_room({"length of array", k + 1}, tuples, 1);
            std::string type_name(scanner_.word({"type of array", k + 1}));
            const std::optional<VtkType> type = find_vtk_type(type_name);
            if (!type) return type_name;
            take_array(name, *type, components, tuples);
            ++k;
        }
        return {};
    }

    std::string read_attribute(const std::string& keyword) {
        if (keyword == "lookup_table") {
            scanner_.word("name");
            const std::uint64_t colours = scanner_.integer("size of lookup table");
            scanner_.require_room("size of lookup table", colours, 4);
            skip_numbers({VtkType::Kind::unsigned_integer, 1}, 4 * colours, "lookup table");
            return {};
        }
        const std::string name(scanner_.word("name"));
        std::uint64_t components = 1;
        VtkType type = {VtkType::Kind::unsigned_integer, 1};
        if (keyword == "color_scalars") {
            components = scanner_.integer("number of components", 1, kMostComponents);
        } else {
            if (keyword == "texture_coordinates")
                components = scanner_.integer("dimension", 1, 3);
            else if (keyword == "vectors" || keyword == "normals")
                components = 3;
            else if (keyword == "tensors")
                components = 9;
            else if (keyword == "tensors6")
                components = 6;
            else if (keyword != "scalars" && keyword != "global_ids" && keyword != "pedigree_ids" &&
                     keyword != "edge_flags")
                return keyword;
            std::string type_name(scanner_.word("type of data"));
            const std::optional<VtkType> known = find_vtk_type(type_name);
            if (!known) return type_name;
            type = *known;
        }
        if (keyword == "scalars") components = read_scalars_head();
        take_array(name, type, components, tuples_);
        return {};
    }

    // The number of components and a table of colours, both optional.
    std::uint64_t read_scalars_head() {
        std::uint64_t components = 1;
        if (!scanner_.at_line_end()) components = scanner_.integer("number of components", 1, 4);
        TextScanner ahead = scanner_;
        if (!ahead.at_end() && ahead.word("LOOKUP_TABLE") == "LOOKUP_TABLE") {
            scanner_.word("LOOKUP_TABLE");
            scanner_.word("name of lookup table");
        }
        return components;
    }

    void take_array(const std::string& name, VtkType type, std::uint64_t components, std::uint64_t tuples) {
        scanner_.require_room("number of data", tuples, 1);
        const std::optional<std::size_t> rank = attribute_rank(name);
        const bool is_attribute = is_of_cells_ && components == 1 && tuples == grid_.types.size() &&
                                  type.is_integer() && rank && (!rank_ || *rank < *rank_);
        if (!is_attribute) return skip_numbers(type, components * tuples, "data");
        rank_ = rank;
        grid_.attributes = read_integers(type, tuples, "attribute of cell");
    }

    const std::filesystem::path& file_;
    TextScanner scanner_;
    bool is_version_5_ = false, is_binary_ = false;
    VtkGrid grid_;
    bool is_of_cells_ = false;
    std::uint64_t tuples_ = 0;         // of the section of data
    std::optional<std::size_t> rank_;  // of the attribute's name
};

}  // namespace

TetMesh read_vtk(const std::filesystem::path& file, Notes& notes) {
    const std::string content = read_file(file);
    return VtkReader(file, content).read(notes);
}

}  // namespace gelatin
