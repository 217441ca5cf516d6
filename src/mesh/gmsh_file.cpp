#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/file.h"
#include "mesh/load_bytes.h"
#include "mesh/tet_formats.h"
#include "mesh/text_scanner.h"
#include "mesh/volume_cells.h"

namespace gelatin {
namespace {

struct ElementTypes {
    CellShape shape;
    std::vector<int> numbers;  // of each type its number and how many nodes it has, corners first
};

// Gmsh's reference manual, "MSH file format"; those of high order from GmshDefines.h. A trihedron (140) joins
// a quadrilateral with two triangles and has no volume.
const std::array<ElementTypes, 5>& element_types() {
    static const std::array<ElementTypes, 5> kTypes = {{
        {CellShape::flat, {1,  2,  2,  3,   3,  4,   8,  3,  9,  6,  10, 9,  15, 1,  16, 8,  20,  9,  21, 10,
                           22, 12, 23, 15,  24, 15,  25, 21, 26, 4,  27, 5,  28, 6,  36, 16, 37,  25, 38, 36,
                           39, 12, 40, 16,  41, 20,  42, 28, 43, 36, 44, 45, 45, 55, 46, 66, 47,  49, 48, 64,
                           49, 81, 50, 100, 51, 121, 52, 18, 53, 21, 54, 24, 55, 27, 56, 30, 57,  24, 58, 28,
                           59, 32, 60, 36,  61, 40,  62, 7,  63, 8,  64, 9,  65, 10, 66, 11, 140, 4}},
        {CellShape::tet, {4,  4,   11, 10,  29, 20,  30, 35, 31, 56, 32, 22, 33, 28, 71, 84, 72,  120,
                          73, 165, 74, 220, 75, 286, 79, 34, 80, 40, 81, 46, 82, 52, 83, 58, 137, 16}},
        {CellShape::hexahedron,
         {5,   8,  12,   27, 17, 20,  92, 64,  93, 125, 94, 216, 95, 343, 96, 512, 97,
          729, 98, 1000, 99, 32, 100, 44, 101, 56, 102, 68, 103, 80, 104, 92, 105, 104}},
        {CellShape::wedge, {6,   6,   13,  18,  18, 15,  90, 40,  91, 75,  106, 126, 107, 196, 108, 288, 109,
                            405, 110, 550, 111, 24, 112, 33, 113, 42, 114, 51,  115, 60,  116, 69,  117, 78}},
        {CellShape::pyramid,
         {7,   5,   14,  14,  19, 13,  118, 30,  119, 55,  120, 91,  121, 140, 122, 204, 123,
          285, 124, 385, 125, 21, 126, 29,  127, 37,  128, 45,  129, 53,  130, 61,  131, 69}},
    }};
    return kTypes;
}

struct Element {
    CellShape shape;
    int node_count;
};

// Maps the numbers that a file gives its nodes, which need not be consecutive, to indices.
class NodeTags {
public:
    void add(std::uint64_t tag) { sorted_.emplace_back(tag, static_cast<std::uint32_t>(sorted_.size())); }

    // Returns a tag that two nodes share, if there is one.
    std::optional<std::uint64_t> sort() {
        std::sort(sorted_.begin(), sorted_.end());
        const auto twin = std::adjacent_find(sorted_.begin(), sorted_.end(),
                                             [](const auto& a, const auto& b) { return a.first == b.first; });
        if (twin == sorted_.end()) return {};
        return twin->first;
    }

    std::optional<std::uint32_t> find(std::uint64_t tag) const {
        if (sorted_.empty() || tag < sorted_.front().first) return {};
        // If the tags are consecutive, the tag gives the index.
        const std::uint64_t guess = tag - sorted_.front().first;
        if (guess < sorted_.size() && sorted_[guess].first == tag) return sorted_[guess].second;
        const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{tag, std::uint32_t{0}});
        if (found == sorted_.end() || found->first != tag) return {};
        return found->second;
    }

private:
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted_;
};

// Reads the numbers of a file: words in a text file, bytes in a binary one.
class Numbers {
public:
    explicit Numbers(TextScanner& scanner) : scanner_(scanner) {}

    /// Also reads the byte order, which follows the line with the format.
    void set_binary() {
        scanner_.skip_line();
        const auto one = load_bytes<std::int32_t>(scanner_.bytes(4, "byte order"), 0, false);
        if (one != 1 && one != 0x01000000) scanner_.fail("byte order", fmt::format("{}", one), "must be 1");
        swapped_ = one != 1;
        binary_ = true;
    }
    bool binary() const { return binary_; }

    std::uint64_t integer(const FieldName& field) {
        if (!binary_) return scanner_.integer(field);
        const auto value = load_bytes<std::int32_t>(scanner_.bytes(4, field), 0, swapped_);
        if (value < 0) scanner_.fail(field, fmt::format("{}", value), "must not be negative");
        return static_cast<std::uint64_t>(value);
    }

    /// A number of 64 bits in a binary file.
    std::uint64_t large_integer(const FieldName& field) {
        if (!binary_) return scanner_.integer(field);
        return load_bytes<std::uint64_t>(scanner_.bytes(8, field), 0, swapped_);
    }

    /// A number that may be negative.
    int signed_integer(const FieldName& field) {
        if (!binary_) return scanner_.signed_integer(field);
        return load_bytes<std::int32_t>(scanner_.bytes(4, field), 0, swapped_);
    }

    double real(const FieldName& field) {
        if (!binary_) return scanner_.number(field);
        return load_bytes<double>(scanner_.bytes(8, field), 0, swapped_);
    }

private:
    TextScanner& scanner_;
    bool binary_ = false, swapped_ = false;
};

class GmshReader {
public:
    GmshReader(const std::filesystem::path& file, std::string_view content)
        : file_(file), scanner_(file, content, 0) {}

    TetMesh read(Notes& notes) {
        read_format();
        bool has_nodes = false, has_elements = false;
        while (!scanner_.at_end()) {
            const std::string section(scanner_.word("section"));
            if (section.front() != '$') scanner_.fail("section", section, "must begin with '$'");
            if (section == "$Elements" && !has_nodes) scanner_.fail("section", section, "must follow $Nodes");
            const std::string end = "$End" + section.substr(1);
            scanner_.skip_line();
            if (section == "$Entities" && is_version_4_) {
                read_entities();
                scanner_.skip_past(end, end.c_str());
            } else if (section == "$Nodes") {
                is_version_4_ ? read_nodes_4() : read_nodes_2();
                sort_tags();
                scanner_.expect(end.c_str());
                has_nodes = true;
            } else if (section == "$Elements") {
                is_version_4_ ? read_elements_4() : read_elements_2();
                scanner_.expect(end.c_str());
                has_elements = true;
            } else {
                scanner_.skip_past(end, end.c_str());
            }
        }
        if (!has_nodes) scanner_.fail_cut_off("$Nodes");
        if (!has_elements) scanner_.fail_cut_off("$Elements");
        return cells_.divide(file_.string(), notes);
    }

private:
    void read_format() {
        scanner_.expect("$MeshFormat");
        const std::string_view version = scanner_.word("version");
        is_version_4_ = version == "4.1";
        if (version != "2.2" && version != "4.1") scanner_.fail("version", version, "must be 2.2 or 4.1");
        const bool binary = scanner_.integer("file type", 0, 1) == 1;
        scanner_.integer("size of numbers", 8, 8);
        if (binary) numbers_.set_binary();
        scanner_.expect("$EndMeshFormat");
    }

    // For each volume its first physical group. Elements do not repeat the group of their entity.
    void read_entities() {
        std::array<std::uint64_t, 4> counts{};
        for (std::uint64_t& count : counts) count = numbers_.large_integer("number of entities");
        for (std::size_t dimension = 0; dimension < 4; ++dimension) {
            for (std::uint64_t entity = 1; entity <= counts[dimension]; ++entity)
                read_entity(static_cast<int>(dimension), {"entity", entity});
        }
    }

    void read_entity(int dimension, const FieldName& field) {
        const int tag = numbers_.signed_integer(field);
        const int extent = dimension == 0 ? 3 : 6;  // a point, or a box
        for (int k = 0; k < extent; ++k) numbers_.real(field);
        const std::uint64_t groups = numbers_.large_integer(field);
        for (std::uint64_t k = 0; k < groups; ++k) {
            const int group = std::abs(numbers_.signed_integer(field));  // negative: reversed orientation
            if (k == 0 && dimension == 3) group_of_volume_[tag] = group;
        }
        if (dimension == 0) return;
        const std::uint64_t bounds = numbers_.large_integer(field);
        for (std::uint64_t k = 0; k < bounds; ++k) numbers_.signed_integer(field);
    }

    void read_nodes_2() {
        const std::size_t count = scanner_.count("number of nodes", numbers_.binary() ? 28 : 8);
        scanner_.skip_line();
        cells_.positions.reserve(count);
        for (std::uint64_t row = 1; row <= count; ++row) {
            tags_.add(numbers_.integer({"number of node", row}));
            cells_.positions.push_back(read_position(row));
        }
    }

    void read_nodes_4() {
        const std::uint64_t blocks = numbers_.large_integer("number of node blocks");
        const std::uint64_t count = numbers_.large_integer("number of nodes");
        numbers_.large_integer("smallest node number");
        numbers_.large_integer("largest node number");
        scanner_.require_room("number of nodes", count, numbers_.binary() ? 32 : 8);
        cells_.positions.reserve(count);
        for (std::uint64_t block = 1; block <= blocks; ++block) read_node_block(block);
        if (cells_.positions.size() != count) {
            scanner_.fail("number of nodes", fmt::format("{}", count),
                          fmt::format("but the blocks have {}", cells_.positions.size()));
        }
    }

    void read_node_block(std::uint64_t block) {
        const std::uint64_t dimension = numbers_.integer({"dimension of node block", block});
        numbers_.signed_integer({"entity of node block", block});
        const bool parametric = numbers_.integer({"'parametric' of node block", block}) != 0;
        const std::uint64_t size = numbers_.large_integer({"size of node block", block});
        const std::uint64_t first = cells_.positions.size() + 1;
        for (std::uint64_t k = 0; k < size; ++k)
            tags_.add(numbers_.large_integer({"number of node", first + k}));
        for (std::uint64_t k = 0; k < size; ++k) {
            cells_.positions.push_back(read_position(first + k));
            const std::uint64_t parameters = parametric ? std::min<std::uint64_t>(dimension, 3) : 0;
            for (std::uint64_t d = 0; d < parameters; ++d) numbers_.real({"parameters of node", first + k});
        }
    }

    glm::dvec3 read_position(std::uint64_t node) {
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis) {
            position[axis] = numbers_.real({"node", node});
            scanner_.require_coordinate(position[axis], {"node", node});
        }
        return position;
    }

    void sort_tags() {
        const auto twin = tags_.sort();
        if (twin) scanner_.fail("number of node", fmt::format("{}", *twin), "must not be given twice");
    }

    // In a text file each element names its type. In a binary file elements of one type are contiguous, after
    // a header.
    void read_elements_2() {
        const std::size_t count = scanner_.count("number of elements", numbers_.binary() ? 8 : 6);
        scanner_.skip_line();
        for (std::uint64_t row = 1; row <= count;) {
            if (!numbers_.binary()) numbers_.integer({"number of element", row});
            const Element type = read_type(row);
            const std::uint64_t together = numbers_.binary() ? numbers_.integer({"elements behind", row}) : 1;
            const std::uint64_t tags = numbers_.integer({"number of tags of element", row});
            if (together == 0 || together > count - row + 1) {
                scanner_.fail("elements of a type", fmt::format("{}", together),
                              fmt::format("must be from 1 to {}", count - row + 1));
            }
            for (const std::uint64_t end = row + together; row < end; ++row) {
                if (numbers_.binary()) numbers_.integer({"number of element", row});
                int group = 0;  // the first tag
                for (std::uint64_t k = 0; k < tags; ++k) {
                    const int tag = numbers_.signed_integer({"tags of element", row});
                    if (k == 0) group = std::abs(tag);
                }
                read_element(type, row, group);
            }
        }
    }

    void read_elements_4() {
        const std::uint64_t blocks = numbers_.large_integer("number of element blocks");
        const std::uint64_t count = numbers_.large_integer("number of elements");
        numbers_.large_integer("smallest element number");
        numbers_.large_integer("largest element number");
        std::uint64_t row = 1;
        for (std::uint64_t block = 1; block <= blocks; ++block) {
            const int dimension = numbers_.signed_integer({"dimension of element block", block});
            const int entity = numbers_.signed_integer({"entity of element block", block});
            const auto known = group_of_volume_.find(entity);
            const int group = dimension == 3 && known != group_of_volume_.end() ? known->second : 0;
            const Element type = read_type(row);
            const std::uint64_t size = numbers_.large_integer({"size of element block", block});
            scanner_.require_room({"size of element block", block}, size, numbers_.binary() ? 16 : 4);
            for (const std::uint64_t end = row + size; row < end; ++row) {
                numbers_.large_integer({"number of element", row});
                read_element(type, row, group);
            }
        }
        if (row - 1 != count) {
            scanner_.fail("number of elements", fmt::format("{}", count),
                          fmt::format("but the blocks have {}", row - 1));
        }
    }

    Element read_type(std::uint64_t row) {
        const std::uint64_t number = numbers_.integer({"type of element", row});
        for (const auto& [shape, numbers] : element_types()) {
            for (std::size_t k = 0; k < numbers.size(); k += 2) {
                if (static_cast<std::uint64_t>(numbers[k]) == number) return {shape, numbers[k + 1]};
            }
        }
        scanner_.fail({"type of element", row}, fmt::format("{}", number),
                      "is not one of Gmsh's that Gelatin knows");
    }

    void read_element(const Element& type, std::uint64_t row, int group) {
        const int needed = static_cast<int>(corner_count(type.shape));
        corners_.clear();
        for (int k = 0; k < type.node_count; ++k) {
            const std::uint64_t tag =
                is_version_4_ ? numbers_.large_integer({"element", row}) : numbers_.integer({"element", row});
            if (k >= needed) continue;
            const auto node = tags_.find(tag);
            if (!node)
                scanner_.fail({"element", row}, fmt::format("{}", tag), "there is no node of this number");
            corners_.push_back(*node);
        }
        if (needed == 0)
            cells_.add_other(type.shape, {});
        else
            cells_.add(type.shape, corners_, type.node_count > needed, group);
    }

    const std::filesystem::path& file_;
    TextScanner scanner_;
    Numbers numbers_{scanner_};
    bool is_version_4_ = false;
    NodeTags tags_;
    std::unordered_map<int, int> group_of_volume_;
    std::vector<std::uint32_t> corners_;  // of the current element
    VolumeCells cells_;
};

}  // namespace

TetMesh read_gmsh(const std::filesystem::path& file, Notes& notes) {
    const std::string content = read_file(file);
    return GmshReader(file, content).read(notes);
}

}  // namespace gelatin
