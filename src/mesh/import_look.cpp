#include "mesh/import_look.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/image_file.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

float linear_of_srgb(float value) {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 color_of(const aiMaterial& material, bool is_gltf) {
    aiColor4D found(1.0f, 1.0f, 1.0f, 1.0f);
    if (!is_gltf || material.Get(AI_MATKEY_BASE_COLOR, found) != AI_SUCCESS)
        material.Get(AI_MATKEY_COLOR_DIFFUSE, found);
    glm::vec3 color(found.r, found.g, found.b);
    for (int k = 0; k < 3; ++k) {
        color[k] = std::isfinite(color[k]) ? std::clamp(color[k], 0.0f, 1.0f) : 1.0f;
        if (!is_gltf) color[k] = linear_of_srgb(color[k]);
    }
    return color;
}

// Empty: none.
std::string image_name_of(const aiMaterial& material) {
    aiString name;
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
        if (material.GetTexture(type, 0, &name) == AI_SUCCESS) return name.C_Str();
    }
    return {};
}

// %20 and the like, as glTF has them in names of files.
std::string without_escapes(const std::string& name) {
    std::string plain;
    for (std::size_t i = 0; i < name.size(); ++i) {
        unsigned value = 0;
        const bool is_escape =
            name[i] == '%' && i + 2 < name.size() && std::sscanf(name.c_str() + i + 1, "%2x", &value) == 1;
        plain += is_escape ? static_cast<char>(value) : name[i];
        if (is_escape) i += 2;
    }
    return plain;
}

// @throws Error if it cannot be read
std::string image_of(const aiScene& scene, const fs::path& file, const std::string& name) {
    if (const aiTexture* embedded = scene.GetEmbeddedTexture(name.c_str())) {
        if (embedded->mHeight != 0) throw InvalidInput({name, 0, {}, {}, "has a format that is not read"});
        return {reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth};
    }
    std::string path = name;
    std::replace(path.begin(), path.end(), '\\', '/');
    const fs::path beside = file.parent_path() / path;
    return read_file(fs::exists(beside) ? beside : file.parent_path() / without_escapes(path));
}

SurfaceMaterial import_material(const aiScene& scene, const aiMaterial& from, const fs::path& file,
                                bool is_gltf, Notes& notes) {
    SurfaceMaterial material{from.GetName().C_Str(), color_of(from, is_gltf), image_name_of(from)};
    if (material.image_name.empty()) return material;
    // A usual mistake: black, by which the image would be multiplied.
    if (!is_gltf && material.color == glm::vec3(0.0f)) material.color = glm::vec3(1.0f);
    try {
        std::string image = image_of(scene, file, material.image_name);
        check_image(image);
        material.image = std::make_shared<const std::string>(std::move(image));
    } catch (const Error& error) {
        notes.push_back(fmt::format("the texture '{}' of material '{}' is left out: {}", material.image_name,
                                    material.name, error.what()));
        material.image_name.clear();
    }
    return material;
}

bool is_assimps_own(const aiMaterial& material) {
    return std::string_view(material.GetName().C_Str()) == AI_DEFAULT_MATERIAL_NAME;
}

}  // namespace

void import_materials(const aiScene& scene, const fs::path& file, bool is_gltf, SurfaceLook& look,
                      Notes& notes) {
    std::vector<std::uint32_t> new_index(scene.mNumMaterials, SurfaceLook::kNone);
    std::vector<bool> is_used(scene.mNumMaterials, false);
    for (const std::uint32_t m : look.face_materials) {
        if (m < is_used.size()) is_used[m] = true;
    }
    for (unsigned int m = 0; m < scene.mNumMaterials; ++m) {
        const aiMaterial& material = *scene.mMaterials[m];
        if (!is_used[m] || is_assimps_own(material)) continue;
        new_index[m] = static_cast<std::uint32_t>(look.materials.size());
        look.materials.push_back(import_material(scene, material, file, is_gltf, notes));
    }
    for (std::uint32_t& m : look.face_materials) m = m < new_index.size() ? new_index[m] : SurfaceLook::kNone;
    if (look.materials.empty()) look.face_materials.clear();
}

}  // namespace gelatin
