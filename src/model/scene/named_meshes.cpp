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

std::string name_of_frames(std::size_t index) {
    return fmt::format("frames in memory {} *", index);
}

// The place of a value in a list, which has it from now on.
template <class Value>
std::size_t place_in(std::vector<Value>& list, const Value& value) {
    const auto known = std::find(list.begin(), list.end(), value);
    const auto place = static_cast<std::size_t>(known - list.begin());
    if (known == list.end()) list.push_back(value);
    return place;
}

template <class Function>
void for_each_shape(Scene& scene, const Function& change) {
    for (ObjectDescription& object : scene.objects) change(object.shape);
    for (ColliderDescription& collider : scene.colliders)
        if (auto* shape = std::get_if<Shape>(&collider.shape)) change(*shape);
}

}  // namespace

InMemory name_meshes(Scene& scene, const std::filesystem::path& folder) {
    InMemory in_memory;
    for_each_shape(scene, [&](Shape& shape) {
        if (const auto* mesh = std::get_if<MeshShape>(&shape))
            shape = FileShape{folder / name_of_mesh(place_in(in_memory.meshes, mesh->mesh))};
    });
    for (ColliderDescription& collider : scene.colliders) {
        if (!collider.animation) continue;
        auto& source = collider.animation->source;
        if (const auto* of = std::get_if<AnimationFrames>(&source))
            source =
                AnimationFiles{folder / name_of_frames(place_in(in_memory.frames, of->frames)), of->rate};
    }
    return in_memory;
}

void restore_meshes(Scene& scene, const InMemory& in_memory) {
    for_each_shape(scene, [&](Shape& shape) {
        const auto* file = std::get_if<FileShape>(&shape);
        if (file == nullptr) return;
        const std::string name = file->file.filename().string();
        for (std::size_t k = 0; k < in_memory.meshes.size(); ++k) {
            if (name != name_of_mesh(k)) continue;
            shape = MeshShape{in_memory.meshes[k]};
            return;
        }
    });
    for (ColliderDescription& collider : scene.colliders) {
        if (!collider.animation) continue;
        const auto* files = std::get_if<AnimationFiles>(&collider.animation->source);
        for (std::size_t k = 0; files != nullptr && k < in_memory.frames.size(); ++k) {
            if (files->pattern.filename().string() != name_of_frames(k)) continue;
            collider.animation->source = AnimationFrames{in_memory.frames[k], files->rate};
            break;
        }
    }
}

}  // namespace gelatin
