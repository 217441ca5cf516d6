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

template <class Struct>
Struct read_as(nb::handle source, const char* where) {
    Struct value{};
    read(source, where, value);
    return value;
}

}  // namespace

Scene scene_of(nb::handle source) {
    return read_as<Scene>(source, "");
}

Material material_of(nb::handle source) {
    return read_as<Material>(source, "material");
}

CameraDescription camera_of(nb::handle source) {
    return read_as<CameraDescription>(source, "camera");
}

AttachmentDescription attachment_of(nb::handle source) {
    return read_as<AttachmentDescription>(source, "attachment");
}

JointMotor motor_of(nb::handle source) {
    return read_as<JointMotor>(source, "motor");
}

CavityGas gas_of(nb::handle pressure, nb::handle amount) {
    CavityGas gas;
    read(pressure, "pressure", gas.pressure);
    read(amount, "amount", gas.amount);
    return gas;
}

Region region_of(nb::handle source) {
    return read_as<Region>(source, "region");
}

nb::object python_scene(const Scene& scene) {
    return to_python(scene);
}

nb::object python_attachments(const Scene& scene) {
    return to_python(scene.attachments);
}

nb::dict scene_defaults() {
    return defaults_of<SimulationSettings, MaterialPair, CollisionSettings, SpringKinds, Material,
                       SphereShape, BoxShape, CapsuleShape, TextShape, MesherSettings, Keyframe,
                       DragDescription, SkeletonDescription, HandleDescription, ForceLoad, TractionLoad,
                       PressureLoad, LoadDescription, PartDescription, StartDescription, RigidDescription,
                       CavityKeyframe, CavityDescription, ObjectDescription, PlaneCollider, AnimationClip,
                       AnimationFiles, AnimationFrames, AnimationDescription, ColliderDescription,
                       JointSpring, MotorKeyframe, JointMotor, AttachmentDescription, CameraDescription,
                       Scene>();
}

}  // namespace gelatin::python
