#include "mesh/gltf_materials.h"

#include <fmt/core.h>

#include "mesh/surface_material.h"

namespace gelatin {

using Json = GltfDocument::Json;

GltfMaterials::GltfMaterials(GltfDocument& document) : document_(document) {
    for (std::size_t m = 0; m < document_.list("materials").size(); ++m) {
        const Json& from = document_.item("materials", m);
        const std::string what = fmt::format("materials[{}]", m);
        Look& look = looks_.emplace_back();
        look.material.name = from.value("name", "");
        const Json none = Json::object();
        const Json pbr = from.value("pbrMetallicRoughness", none),
                   extensions = from.value("extensions", none);
        read(pbr, "baseColorFactor", "baseColorTexture", what, look);
        read(extensions.value("KHR_materials_pbrSpecularGlossiness", none), "diffuseFactor", "diffuseTexture",
             what, look);
    }
}

void GltfMaterials::read(const Json& from, const char* color_key, const char* texture_key,
                         const std::string& what, Look& look) const {
    if (const auto color = document_.numbers(from, color_key, 4, what)) {
        for (int k = 0; k < 3; ++k)
            look.material.color[k] = color_component((*color)[static_cast<std::size_t>(k)]);
    }
    const auto texture = from.find(texture_key);
    if (texture == from.end()) return;
    look.uv_set = document_.optional_number(*texture, "texCoord", what).value_or(0);
    const Json& item = document_.item("textures", document_.whole_number(*texture, "index", what));
    look.image = document_.optional_number(item, "source", what);
    look.lacks_image = !look.image;  // but one of an extension
    const auto extensions = texture->find("extensions");
    look.has_transform = extensions != texture->end() && extensions->contains("KHR_texture_transform");
}

std::uint32_t GltfMaterials::index_of(const Json& primitive, const std::string& what) const {
    const auto index = document_.optional_number(primitive, "material", what);
    return index && *index < looks_.size() ? static_cast<std::uint32_t>(*index) : SurfaceLook::kNone;
}

std::size_t GltfMaterials::uv_set(std::uint32_t material) const {
    return material == SurfaceLook::kNone ? 0 : looks_[material].uv_set;
}

void GltfMaterials::load(Look& look, Notes& notes) {
    const std::string uri = document_.item("images", *look.image).value("uri", "");
    const bool is_embedded = uri.empty() || uri.starts_with("data:");
    look.material.image_name = is_embedded ? fmt::format("*{}", *look.image) : uri;
    load_image(
        look.material, [&] { return document_.read_image(*look.image); }, notes);
}

void GltfMaterials::finish(SurfacePolygons& polygons, Notes& notes, Ignored& ignored) {
    std::vector<std::uint32_t> new_index(looks_.size(), SurfaceLook::kNone);
    for (std::uint32_t& m : polygons.polygon_materials) {
        if (m == SurfaceLook::kNone) continue;
        Look& look = looks_[m];
        if (new_index[m] == SurfaceLook::kNone) {
            if (look.image) load(look, notes);
            ignored.add("textures of formats that are neither PNG nor JPEG", look.lacks_image ? 1 : 0);
            ignored.add("transforms of textures", look.has_transform ? 1 : 0);
            new_index[m] = static_cast<std::uint32_t>(polygons.materials.size());
            polygons.materials.push_back(std::move(look.material));
        }
        m = new_index[m];
    }
    if (polygons.materials.empty()) polygons.polygon_materials.clear();
}

}  // namespace gelatin
