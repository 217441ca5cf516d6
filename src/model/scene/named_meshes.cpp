#include "model/scene/named_meshes.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <variant>

namespace gelatin {
namespace {

std::string name_of_mesh(std::size_t index) {
    return fmt::format("mesh in memory {}", index);
}

template <class Function>
void for_each_shape(Scene& scene, const Function& change) {
    for (ObjectDescription& object : scene.objects) change(object.shape);
    for (ColliderDescription& collider : scene.colliders)
        if (auto* shape = std::get_if<Shape>(&collider.shape)) change(*shape);
}

}  // namespace

std::vector<std::shared_ptr<const Mesh>> name_meshes(Scene& scene, const std::filesystem::path& folder) {
    std::vector<std::shared_ptr<const Mesh>> meshes;
    for_each_shape(scene, [&](Shape& shape) {
        const auto* in_memory = std::get_if<MeshShape>(&shape);
        if (in_memory == nullptr) return;
        auto known = std::find(meshes.begin(), meshes.end(), in_memory->mesh);
        if (known == meshes.end()) known = meshes.insert(meshes.end(), in_memory->mesh);
        shape = FileShape{folder / name_of_mesh(static_cast<std::size_t>(known - meshes.begin()))};
    });
    return meshes;
}

void restore_meshes(Scene& scene, const std::vector<std::shared_ptr<const Mesh>>& meshes) {
    for_each_shape(scene, [&](Shape& shape) {
        const auto* file = std::get_if<FileShape>(&shape);
        if (file == nullptr) return;
        const std::string name = file->file.filename().string();
        for (std::size_t k = 0; k < meshes.size(); ++k) {
            if (name != name_of_mesh(k)) continue;
            shape = MeshShape{meshes[k]};
            return;
        }
    });
}

}  // namespace gelatin
