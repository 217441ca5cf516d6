#include "mesh/obj_materials.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "mesh/surface_material.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

std::string with_slashes(std::string_view name) {
    std::string path(name);
    std::replace(path.begin(), path.end(), '\\', '/');
    return path;
}

std::string_view take_word(std::string_view& text) {
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(text.find_first_not_of(" \t", end), text.size()));
    return word;
}

bool is_number(std::string_view word) {
    return !word.empty() && word.find_first_not_of("0123456789.+-eE") == std::string_view::npos;
}

// What is left of a `map_Kd` statement without its options: a name, which may contain blanks.
std::string_view image_name_of(std::string_view arguments) {
    while (arguments.starts_with('-')) {
        const std::string_view option = take_word(arguments);
        const bool has_vector = option == "-o" || option == "-s" || option == "-t";
        const int values = has_vector ? 3 : option == "-mm" ? 2 : 1;
        for (int k = 0; k < values; ++k) {
            std::string_view after = arguments;
            const std::string_view value = take_word(after);
            if (has_vector && !is_number(value)) break;
            arguments = after;
        }
    }
    return arguments;
}

// Kd r g b, or one value for all three. Curves of a spectrum are no colour.
glm::vec3 read_color(TextScanner& scanner) {
    glm::vec3 color(1.0f);
    for (int k = 0; k < 3; ++k) {
        if (k > 0 && scanner.at_line_end()) return glm::vec3(color.x);
        color[k] = linear_of_srgb(color_component(scanner.number("Kd")));
    }
    return color;
}

}  // namespace

void ObjMaterials::read_libraries(std::string_view names) {
    if (fs::is_regular_file(obj_file_.parent_path() / with_slashes(names)))
        return read_library(std::string(names));
    std::string name;  // which may contain blanks, and ends in .mtl
    while (!names.empty()) {
        name += (name.empty() ? "" : " ") + std::string(take_word(names));
        if (names.empty() || lower_case_ending(name) == ".mtl") read_library(std::exchange(name, {}));
    }
}

void ObjMaterials::read_library(const std::string& name) {
    try {
        const fs::path file = obj_file_.parent_path() / with_slashes(name);
        const std::string content = read_file(file);
        has_library_ = true;
        for (TextScanner scanner(file, content); !scanner.at_end(); scanner.skip_line())
            define(scanner, file.parent_path());
    } catch (const InvalidInput& error) {
        const bool is_missing = error.problem().line == 0;
        lacks_library_ = lacks_library_ || is_missing;
        notes_.push_back(
            is_missing ? fmt::format("'{}' cannot be read, and what it says of materials is left out", name)
                       : fmt::format("the materials from here on are left out: {}", error.what()));
    }
}

// One statement.
void ObjMaterials::define(TextScanner& scanner, const fs::path& folder) {
    const std::string keyword = lower_case(scanner.word("keyword"));
    if (keyword == "newmtl") {
        current_ = &definitions_[std::string(scanner.rest_of_line())];
        *current_ = {{}, folder};
    } else if (current_ == nullptr || scanner.at_line_end()) {
        return;
    } else if (keyword == "kd") {
        const std::string_view kind = TextScanner(scanner).word("Kd");
        if (kind != "spectral" && kind != "xyz") current_->material.color = read_color(scanner);
    } else if (keyword == "map_kd") {
        current_->material.image_name = image_name_of(scanner.rest_of_line());
    }
}

std::uint32_t ObjMaterials::number_of(std::string_view name) {
    const auto [entry, is_new] =
        numbers_.try_emplace(std::string(name), static_cast<std::uint32_t>(used_.size()));
    if (is_new) used_.emplace_back(name);
    return entry->second;
}

std::string ObjMaterials::read_image(const Definition& definition) const {
    const fs::path name = with_slashes(definition.material.image_name);
    const fs::path beside = definition.folder / name;
    return read_file(fs::exists(beside) ? beside : obj_file_.parent_path() / name);
}

void ObjMaterials::finish(SurfacePolygons& polygons) {
    std::vector<std::size_t> uses(used_.size(), 0);
    for (const std::uint32_t number : polygons.polygon_materials) {
        if (number != SurfaceLook::kNone) ++uses[number];
    }
    std::vector<std::uint32_t> index(used_.size(), SurfaceLook::kNone);
    for (std::size_t number = 0; number < used_.size(); ++number) {
        if (uses[number] == 0 || !has_library_) continue;
        const auto found = definitions_.find(used_[number]);
        if (found == definitions_.end()) {
            if (!lacks_library_) {
                notes_.push_back(fmt::format("no material file defines '{}', which faces have: {}",
                                             used_[number], uses[number]));
            }
            continue;
        }
        SurfaceMaterial material = found->second.material;
        material.name = used_[number];
        if (!material.image_name.empty()) {
            // A usual mistake: black, by which the image would be multiplied.
            if (material.color == glm::vec3(0.0f)) material.color = glm::vec3(1.0f);
            load_image(
                material, [&] { return read_image(found->second); }, notes_);
        }
        index[number] = static_cast<std::uint32_t>(polygons.materials.size());
        polygons.materials.push_back(std::move(material));
    }
    for (std::uint32_t& number : polygons.polygon_materials) {
        if (number != SurfaceLook::kNone) number = index[number];
    }
    if (polygons.materials.empty()) polygons.polygon_materials.clear();
}

}  // namespace gelatin
