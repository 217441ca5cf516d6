#pragma once

#include "object_fields.h"
#include "setting_fields.h"
#include "shape_fields.h"

namespace gelatin::python {

template <>
struct Fields<Scene> {
    static constexpr const char* kClass = "Scene";
    static void visit(Scene& s, auto&& field) {
        auto& [file, simulation, collision, materials, objects, colliders, attachments, camera, meshes, up] =
            s;
        field("file", file);
        field("simulation", simulation);
        field("collision", collision);
        field("materials", materials);
        field("objects", objects);
        field("colliders", colliders);
        field("attachments", attachments);
        field("camera", camera);
        field("meshes", meshes);
        field("up", up);
    }
};

}  // namespace gelatin::python
