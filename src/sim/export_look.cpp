#include "sim/export_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

namespace gelatin {
namespace {

constexpr const char* kNoMaterial = "none";

float srgb_of(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

// Without what ends a name in an OBJ file or leaves the folder; each once.
std::vector<std::string> names_of(const std::vector<SurfaceMaterial>& materials) {
    std::vector<std::string> names;
    for (const SurfaceMaterial& material : materials) {
        std::string name = material.name.empty() ? "material" : material.name;
        std::replace_if(
            name.begin(), name.end(),
            [](unsigned char c) { return c <= ' ' || c == '/' || c == '\\' || c == '#'; }, '_');
        const bool is_taken =
            name == kNoMaterial || std::find(names.begin(), names.end(), name) != names.end();
        names.push_back(is_taken ? fmt::format("{}_{}", name, names.size() + 1) : name);
    }
    return names;
}

bool is_png(const std::string& image) {
    return image.starts_with("\x89PNG");
}

}  // namespace

ObjLook::ObjLook(const SurfaceLook& look) : look_(look), names_(names_of(look.materials)) {
    if (look.is_empty()) return;
    auto out = std::back_inserter(library_);
    fmt::format_to(out, "newmtl {}\nKd 0.8 0.8 0.8\n", kNoMaterial);
    for (std::size_t m = 0; m < names_.size(); ++m) {
        const SurfaceMaterial& material = look.materials[m];
        const glm::vec3& c = material.color;
        fmt::format_to(out, "newmtl {}\nKd {} {} {}\n", names_[m], srgb_of(c.r), srgb_of(c.g), srgb_of(c.b));
        if (material.image == nullptr) continue;
        images_.push_back({names_[m] + (is_png(*material.image) ? ".png" : ".jpg"), material.image});
        fmt::format_to(out, "map_Kd {}\n", images_.back().name);
    }
}

std::string ObjLook::name_of(std::uint32_t material) const {
    return material == SurfaceLook::kNone ? kNoMaterial : names_[material];
}

std::string ObjLook::face_lines(std::span<const Face> faces, std::uint32_t first) {
    std::string coordinates, lines;
    std::map<std::array<float, 2>, std::uint32_t> known;  // numbers of coordinates
    const bool has_uvs = !look_.corner_uvs.empty(), has_materials = !look_.face_materials.empty();
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t in_look = first + f;
        if (has_materials && (f == 0 || look_.face_materials[in_look] != look_.face_materials[in_look - 1]))
            fmt::format_to(std::back_inserter(lines), "usemtl {}\n", name_of(look_.face_materials[in_look]));
        lines += 'f';
        const std::array<std::uint32_t, 3> corners{faces[f].a, faces[f].b, faces[f].c};
        for (std::size_t k = 0; k < 3; ++k) {  // OBJ counts from 1
            fmt::format_to(std::back_inserter(lines), " {}", corners[k] + 1);
            if (!has_uvs) continue;
            const glm::vec2& uv = look_.corner_uvs[in_look][k];
            const auto [found, is_new] = known.try_emplace({uv.x, uv.y}, uv_count_ + 1);
            if (is_new) {
                fmt::format_to(std::back_inserter(coordinates), "vt {} {}\n", uv.x, uv.y);
                ++uv_count_;
            }
            fmt::format_to(std::back_inserter(lines), "/{}", found->second);
        }
        lines += '\n';
    }
    return coordinates + lines;
}

}  // namespace gelatin
