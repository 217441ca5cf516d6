#include "scene_conversion.h"

#include "convert.h"

namespace gelatin::python {
namespace {

template <class... Structs>
nb::dict defaults_of() {
    nb::dict all;
    const auto add = [&](auto value) {
        nb::dict fields;
        using Struct = decltype(value);
        Fields<Struct>::visit(value,
                              [&](const char* name, auto& member) { fields[name] = to_python(member); });
        all[Fields<Struct>::kClass] = fields;
    };
    (add(Structs{}), ...);
    return all;
}

}  // namespace

Scene scene_of(nb::handle source) {
    Scene scene;
    read(source, "scene", scene);
    return scene;
}

nb::object python_scene(const Scene& scene) {
    return to_python(scene);
}

nb::dict scene_defaults() {
    return defaults_of<SimulationSettings, MaterialPair, CollisionSettings, SpringKinds, Material,
                       SphereShape, BoxShape, CapsuleShape, TextShape, MesherSettings, Keyframe,
                       DragDescription, HandleDescription, ForceLoad, TractionLoad, PressureLoad,
                       LoadDescription, PartDescription, StartDescription, ObjectDescription, PlaneCollider,
                       ColliderDescription, CameraDescription, Scene>();
}

}  // namespace gelatin::python
