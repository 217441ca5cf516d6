#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/file.h"
#include "mesh/load_bytes.h"
#include "mesh/tet_formats.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

struct ElementType {
    std::uint64_t number;
    int node_count;
    bool is_tet;  // of any order; the corners come first
};

// Gmsh's reference manual, "MSH file format".
constexpr std::array<ElementType, 34> kElementTypes = {{
    {1, 2, false},   {2, 3, false},   {3, 4, false},    {4, 4, true},    {5, 8, false},   {6, 6, false},
    {7, 5, false},   {8, 3, false},   {9, 6, false},    {10, 9, false},  {11, 10, true},  {12, 27, false},
    {13, 18, false}, {14, 14, false}, {15, 1, false},   {16, 8, false},  {17, 20, false}, {18, 15, false},
    {19, 13, false}, {20, 9, false},  {21, 10, false},  {22, 12, false}, {23, 15, false}, {24, 15, false},
    {25, 21, false}, {26, 4, false},  {27, 5, false},   {28, 6, false},  {29, 20, true},  {30, 35, true},
    {31, 56, true},  {92, 64, false}, {93, 125, false}, {36, 16, false},
}};

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
    GmshReader(const std::filesystem::path& file, std::string_view content) : scanner_(file, content, 0) {}

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
        if (skipped_ > 0) notes.push_back(fmt::format("skipped elements that are not tets: {}", skipped_));
        if (curved_ > 0)
            notes.push_back(fmt::format("kept the corners only of tets with more nodes: {}", curved_));
        return std::move(mesh_);
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
        mesh_.positions.reserve(count);
        for (std::uint64_t row = 1; row <= count; ++row) {
            tags_.add(numbers_.integer({"number of node", row}));
            mesh_.positions.push_back(read_position(row));
        }
    }

    void read_nodes_4() {
        const std::uint64_t blocks = numbers_.large_integer("number of node blocks");
        const std::uint64_t count = numbers_.large_integer("number of nodes");
        numbers_.large_integer("smallest node number");
        numbers_.large_integer("largest node number");
        scanner_.require_room("number of nodes", count, numbers_.binary() ? 32 : 8);
        mesh_.positions.reserve(count);
        for (std::uint64_t block = 1; block <= blocks; ++block) read_node_block(block);
        if (mesh_.positions.size() != count) {
            scanner_.fail("number of nodes", fmt::format("{}", count),
                          fmt::format("but the blocks have {}", mesh_.positions.size()));
        }
    }

    void read_node_block(std::uint64_t block) {
        const std::uint64_t dimension = numbers_.integer({"dimension of node block", block});
        numbers_.signed_integer({"entity of node block", block});
        const bool parametric = numbers_.integer({"'parametric' of node block", block}) != 0;
        const std::uint64_t size = numbers_.large_integer({"size of node block", block});
        const std::uint64_t first = mesh_.positions.size() + 1;
        for (std::uint64_t k = 0; k < size; ++k)
            tags_.add(numbers_.large_integer({"number of node", first + k}));
        for (std::uint64_t k = 0; k < size; ++k) {
            mesh_.positions.push_back(read_position(first + k));
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
            const ElementType& type = read_type(row);
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
            const ElementType& type = read_type(row);
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

    const ElementType& read_type(std::uint64_t row) {
        const std::uint64_t number = numbers_.integer({"type of element", row});
        for (const ElementType& type : kElementTypes) {
            if (type.number == number) return type;
        }
        scanner_.fail({"type of element", row}, fmt::format("{}", number),
                      "is not one of Gmsh's that Gelatin knows");
    }

    void read_element(const ElementType& type, std::uint64_t row, int group) {
        glm::uvec4 tet;
        for (int k = 0; k < type.node_count; ++k) {
            const std::uint64_t tag =
                is_version_4_ ? numbers_.large_integer({"element", row}) : numbers_.integer({"element", row});
            if (!type.is_tet || k >= 4) continue;
            const auto node = tags_.find(tag);
            if (!node)
                scanner_.fail({"element", row}, fmt::format("{}", tag), "there is no node of this number");
            tet[k] = *node;
        }
        if (!type.is_tet) {
            ++skipped_;
            return;
        }
        if (type.node_count > 4) ++curved_;
        mesh_.tets.push_back(tet);
        mesh_.attributes.push_back(group);
    }

    TextScanner scanner_;
    Numbers numbers_{scanner_};
    bool is_version_4_ = false;
    NodeTags tags_;
    std::unordered_map<int, int> group_of_volume_;
    TetMesh mesh_;
    std::size_t skipped_ = 0, curved_ = 0;
};

}  // namespace

TetMesh read_gmsh(const std::filesystem::path& file, Notes& notes) {
    const std::string content = read_file(file);
    return GmshReader(file, content).read(notes);
}

}  // namespace gelatin
