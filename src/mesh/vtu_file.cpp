// VTK's XML format of unstructured grids: "VTK XML Formats", docs.vtk.org.
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <utility>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/load_bytes.h"
#include "mesh/tet_formats.h"
#include "mesh/text_scanner.h"
#include "mesh/vtk_grid.h"
#include "mesh/vtu_bytes.h"

namespace gelatin {
namespace {

class VtuReader {
public:
    VtuReader(const std::filesystem::path& file, std::string_view content) : file_(file), content_(content) {}

    TetMesh read(Notes& notes) {
        split_appended();
        parse();
        const pugi::xml_node root = document_.child("VTKFile");
        if (!root) refuse(root, "VTKFile", {}, "is missing: this is no file of VTK's");
        read_coding(root);
        const pugi::xml_node grid = need_child(root, "UnstructuredGrid");
        VtkCells mesh(file_);
        for (const pugi::xml_node piece : grid.children("Piece")) read_piece(piece, mesh);
        return mesh.finish(notes);
    }

private:
    // Raw appended data are no XML: the document ends in front of them.
    void split_appended() {
        constexpr std::string_view kTag = "<AppendedData";
        head_ = content_;
        const std::size_t tag = content_.find(kTag);
        if (tag == std::string_view::npos) return;
        const std::size_t end = content_.find('>', tag);
        const std::size_t mark = content_.find('_', std::min(end, content_.size()));
        head_ = content_.substr(0, tag);
        if (mark == std::string_view::npos) return;
        appended_is_base64_ = content_.substr(tag, end - tag).find("base64") != std::string_view::npos;
        appended_ = content_.substr(mark + 1);
    }

    void parse() {
        std::string text(head_);
        if (head_.size() < content_.size()) text += "</VTKFile>";
        // Text as it is: its length has to be that in the file.
        constexpr unsigned kOptions = pugi::parse_default & ~(pugi::parse_eol | pugi::parse_escapes);
        const pugi::xml_parse_result result =
            document_.load_buffer(text.data(), text.size(), kOptions, pugi::encoding_utf8);
        if (result) return;
        throw InvalidInput({file_.string(),
                            line_at(static_cast<std::size_t>(result.offset)),
                            {},
                            {},
                            fmt::format("is not valid XML: {}", result.description())});
    }

    void read_coding(const pugi::xml_node& root) {
        expect(root, "type", "UnstructuredGrid");
        const std::string order = root.attribute("byte_order").as_string("LittleEndian");
        if (order != "LittleEndian" && order != "BigEndian")
            refuse(root, "byte_order", order, "must be LittleEndian or BigEndian");
        coding_.is_swapped = (order == "BigEndian") != kLittleIsSwapped;
        const std::string header = root.attribute("header_type").as_string("UInt32");
        if (header != "UInt32" && header != "UInt64")
            refuse(root, "header_type", header, "must be UInt32 or UInt64");
        coding_.header_size = header == "UInt32" ? 4 : 8;
        const std::string compressor = root.attribute("compressor").as_string();
        if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
            refuse(root, "compressor", compressor, "must be vtkZLibDataCompressor, or there must be none");
        coding_.is_compressed = !compressor.empty();
    }

    void read_piece(const pugi::xml_node& piece, VtkCells& mesh) const {
        const std::uint64_t points = need_count(piece, "NumberOfPoints");
        const std::uint64_t cells = need_count(piece, "NumberOfCells");
        if (points == 0 && cells == 0) return;
        VtkGrid grid;
        read_points(need_child(need_child(piece, "Points"), "DataArray"), points, grid);
        const pugi::xml_node parts = need_child(piece, "Cells");
        grid.connectivity = read_integers(need_array(parts, "connectivity"));
        grid.ends = read_integers(need_array(parts, "offsets"), cells);
        grid.types = read_integers(need_array(parts, "types"), cells);
        if (const pugi::xml_node attribute = find_attribute(piece.child("CellData")))
            grid.attributes = read_integers(attribute, cells);
        mesh.add(grid, line_of(parts));
    }

    pugi::xml_node find_attribute(const pugi::xml_node& cell_data) const {
        pugi::xml_node best;
        std::optional<std::size_t> best_rank;
        for (const pugi::xml_node array : cell_data.children("DataArray")) {
            const std::optional<std::size_t> rank = attribute_rank(array.attribute("Name").as_string());
            const std::optional<VtkType> type = find_vtk_type(array.attribute("type").as_string());
            const bool fits =
                rank && type && type->is_integer() && array.attribute("NumberOfComponents").as_int(1) == 1;
            if (!fits || (best_rank && *best_rank <= *rank)) continue;
            best = array;
            best_rank = rank;
        }
        return best;
    }

    void read_points(const pugi::xml_node& array, std::uint64_t count, VtkGrid& grid) const {
        expect(array, "NumberOfComponents", "3");
        const std::vector<double> numbers = read_reals(array);
        check_length(array, numbers.size(), count, 3);
        grid.points.reserve(count);
        for (std::size_t k = 0; k < numbers.size(); k += 3)
            grid.points.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
    }

    std::vector<double> read_reals(const pugi::xml_node& array) const {
        TextScanner scanner = scanner_at(array);
        std::vector<double> numbers;
        if (is_ascii(array)) {
            while (!scanner.at_end())
                numbers.push_back(scanner.coordinate({"point", numbers.size() / 3 + 1}));
            return numbers;
        }
        numbers = load_array<double>(array);
        for (std::size_t k = 0; k < numbers.size(); ++k)
            scanner.require_coordinate(numbers[k], {"point", k / 3 + 1});
        return numbers;
    }

    std::vector<std::int64_t> read_integers(const pugi::xml_node& array,
                                            std::optional<std::uint64_t> count = {}) const {
        std::vector<std::int64_t> numbers;
        if (is_ascii(array)) {
            TextScanner scanner = scanner_at(array);
            const char* name = array.attribute("Name").as_string();
            while (!scanner.at_end()) numbers.push_back(scanner.large_integer({name, numbers.size() + 1}));
        } else {
            numbers = load_array<std::int64_t>(array);
        }
        if (count) check_length(array, numbers.size(), *count, 1);
        return numbers;
    }

    // Counts are compared, never believed: a division, because the product may overflow.
    void check_length(const pugi::xml_node& array, std::size_t length, std::uint64_t count,
                      std::uint64_t components) const {
        if (length / components == count && length % components == 0) return;
        refuse(array, describe(array), fmt::format("{} numbers", length),
               fmt::format("must be {} times {} numbers", count, components));
    }

    template <class T>
    std::vector<T> load_array(const pugi::xml_node& array) const {
        const char* type_name = array.attribute("type").as_string();
        const std::optional<VtkType> type = find_vtk_type(type_name);
        const bool fits = type && (std::is_same_v<T, double> || type->is_integer());
        if (!fits)
            refuse(array, "type of " + describe(array), type_name, "must be one of numbers, such as Int64");
        const std::string bytes = decode(array);
        if (bytes.size() % type->size != 0)
            refuse(array, describe(array), fmt::format("{} bytes", bytes.size()),
                   fmt::format("must be a multiple of {}", type->size));
        std::vector<T> numbers;
        numbers.reserve(bytes.size() / type->size);
        for (std::size_t k = 0; k < bytes.size(); k += type->size)
            numbers.push_back(load_vtk_number<T>(*type, bytes, k, coding_.is_swapped));
        return numbers;
    }

    std::string decode(const pugi::xml_node& array) const {
        const std::string format = array.attribute("format").as_string("ascii");
        VtuCoding coding = coding_;
        std::string_view text = array.text().get();
        if (format == "appended") {
            coding.is_base64 = appended_is_base64_;
            const char* offset_text = array.attribute("offset").as_string();
            const std::uint64_t offset = array.attribute("offset").as_ullong();
            if (offset >= appended_.size())
                refuse(array, "offset of " + describe(array), offset_text,
                       fmt::format("the appended data have {} bytes", appended_.size()));
            text = appended_.substr(offset);
        } else if (format != "binary") {
            refuse(array, "format of " + describe(array), format, "must be ascii, binary or appended");
        }
        try {
            return decode_vtu_bytes(text, coding);
        } catch (const InvalidInput& error) {
            refuse(array, describe(array), {}, error.problem().problem);
        }
    }

    static bool is_ascii(const pugi::xml_node& array) {
        return std::strcmp(array.attribute("format").as_string("ascii"), "ascii") == 0;
    }

    static std::string describe(const pugi::xml_node& array) {
        const char* name = array.attribute("Name").as_string();
        return *name == '\0' ? "DataArray" : fmt::format("DataArray {}", name);
    }

    // Reads the text of an array, with the line numbers of the file.
    TextScanner scanner_at(const pugi::xml_node& array) const {
        const pugi::xml_node text = array.text().data();
        const std::size_t begin = static_cast<std::size_t>((text ? text : array).offset_debug());
        const std::size_t length = text ? std::strlen(text.value()) : 0;
        TextScanner scanner(file_, head_.substr(0, begin + length), 0);
        scanner.skip_to(begin);
        return scanner;
    }

    pugi::xml_node need_child(const pugi::xml_node& parent, const char* name) const {
        const pugi::xml_node child = parent.child(name);
        if (!child) refuse(parent, name, {}, "is missing");
        return child;
    }

    pugi::xml_node need_array(const pugi::xml_node& parent, const char* name) const {
        const pugi::xml_node array = parent.find_child_by_attribute("DataArray", "Name", name);
        if (!array) refuse(parent, fmt::format("DataArray {}", name), {}, "is missing");
        return array;
    }

    std::uint64_t need_count(const pugi::xml_node& node, const char* name) const {
        const char* text = node.attribute(name).as_string();
        const bool is_number =
            *text != '\0' && std::strlen(text) < 20 &&
            std::all_of(text, text + std::strlen(text), [](char c) { return c >= '0' && c <= '9'; });
        if (!is_number) refuse(node, name, text, "must be a whole number");
        return node.attribute(name).as_ullong();
    }

    void expect(const pugi::xml_node& node, const char* attribute, const char* value) const {
        const char* found = node.attribute(attribute).as_string(value);
        if (std::strcmp(found, value) != 0) refuse(node, attribute, found, fmt::format("must be {}", value));
    }

    int line_at(std::size_t offset) const {
        return 1 + static_cast<int>(std::count(
                       head_.begin(),
                       head_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, head_.size())), '\n'));
    }
    int line_of(const pugi::xml_node& node) const {
        return node && node.offset_debug() > 0 ? line_at(static_cast<std::size_t>(node.offset_debug())) : 0;
    }

    [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& field, const std::string& value,
                             const std::string& problem) const {
        throw InvalidInput({file_.string(), line_of(node), field, printable(value), problem});
    }

    const std::filesystem::path& file_;
    std::string_view content_, head_, appended_;
    bool appended_is_base64_ = false;
    pugi::xml_document document_;
    VtuCoding coding_;
};

}  // namespace

TetMesh read_vtu(const std::filesystem::path& file, Notes& notes) {
    const std::string content = read_file(file);
    return VtuReader(file, content).read(notes);
}

}  // namespace gelatin
