#pragma once

#include <array>
#include <utility>

#include "gelatin/scene.h"

namespace gelatin::python {

/// The name of a struct's Python class, and its fields by the names of that class' attributes. The structured
/// bindings do not compile when scene.h has a field that is missing here.
template <class Struct>
struct Fields;

template <class Struct>
concept HasFields = requires {
    Fields<Struct>::kClass;
};

template <>
struct Fields<SimulationSettings> {
    static constexpr const char* kClass = "SimulationSettings";
    static void visit(SimulationSettings& s, auto&& field) {
        auto& [solver, forces, frame_rate, substeps, iterations, gravity, frames] = s;
        field("solver", solver);
        field("forces", forces);
        field("frame_rate", frame_rate);
        field("substeps", substeps);
        field("iterations", iterations);
        field("gravity", gravity);
        field("frames", frames);
    }
};

template <>
struct Fields<MaterialPair> {
    static constexpr const char* kClass = "MaterialPair";
    static void visit(MaterialPair& p, auto&& field) {
        auto& [first, second, friction, contact_stiffness, restitution] = p;
        field("first", first);
        field("second", second);
        field("friction", friction);
        field("contact_stiffness", contact_stiffness);
        field("restitution", restitution);
    }
};

template <>
struct Fields<CollisionSettings> {
    static constexpr const char* kClass = "CollisionSettings";
    static void visit(CollisionSettings& c, auto&& field) {
        auto& [broad_phase, detection, response, self_collision, proximity_radius, friction, restitution,
               pairs] = c;
        field("broad_phase", broad_phase);
        field("detection", detection);
        field("response", response);
        field("self_collision", self_collision);
        field("proximity_radius", proximity_radius);
        field("friction", friction);
        field("restitution", restitution);
        field("pairs", pairs);
    }
};

template <>
struct Fields<SpringKinds> {
    static constexpr const char* kClass = "SpringKinds";
    static void visit(SpringKinds& k, auto&& field) {
        auto& [structural, shear, flex] = k;
        field("structural", structural);
        field("shear", shear);
        field("flex", flex);
    }
};

template <>
struct Fields<Material> {
    static constexpr const char* kClass = "Material";
    static void visit(Material& m, auto&& field) {
        auto& [name, model, youngs_modulus, density, poisson_ratio, damping, springs, friction, thickness,
               contact_stiffness, restitution, line] = m;
        field("name", name);
        field("model", model);
        field("youngs_modulus", youngs_modulus);
        field("density", density);
        field("poisson_ratio", poisson_ratio);
        field("damping", damping);
        field("springs", springs);
        field("friction", friction);
        field("thickness", thickness);
        field("contact_stiffness", contact_stiffness);
        field("restitution", restitution);
        field("line", line);
    }
};

template <>
struct Fields<SphereShape> {
    static constexpr const char* kClass = "Sphere";
    static void visit(SphereShape& s, auto&& field) {
        auto& [radius, frequency] = s;
        field("radius", radius);
        field("frequency", frequency);
    }
};

template <>
struct Fields<BoxShape> {
    static constexpr const char* kClass = "Box";
    static void visit(BoxShape& b, auto&& field) {
        auto& [size, segments] = b;
        field("size", size);
        field("segments", segments);
    }
};

template <>
struct Fields<CapsuleShape> {
    static constexpr const char* kClass = "Capsule";
    static void visit(CapsuleShape& c, auto&& field) {
        auto& [radius, length, frequency] = c;
        field("radius", radius);
        field("length", length);
        field("frequency", frequency);
    }
};

template <>
struct Fields<TextShape> {
    static constexpr const char* kClass = "Text";
    static void visit(TextShape& t, auto&& field) {
        auto& [text, depth, size, font] = t;
        field("text", text);
        field("depth", depth);
        field("size", size);
        field("font", font);
    }
};

template <>
struct Fields<FileShape> {
    static constexpr const char* kClass = "File";
    static void visit(FileShape& f, auto&& field) {
        auto& [file] = f;
        field("file", file);
    }
};

/// Converted by mesh_conversion.cpp, from and to arrays.
template <>
struct Fields<MeshShape> {
    static constexpr const char* kClass = "Mesh";
};

template <>
struct Fields<MesherSettings> {
    static constexpr const char* kClass = "Mesher";
    static void visit(MesherSettings& m, auto&& field) {
        auto& [kind, quality, time_limit, nodes, max_volume, cell_size] = m;
        field("kind", kind);
        field("quality", quality);
        field("time_limit", time_limit);
        field("nodes", nodes);
        field("max_volume", max_volume);
        field("cell_size", cell_size);
    }
};

template <>
struct Fields<BoxRegion> {
    static constexpr const char* kClass = "BoxRegion";
    static void visit(BoxRegion& r, auto&& field) {
        auto& [min, max] = r;
        field("min", min);
        field("max", max);
    }
};

template <>
struct Fields<SphereRegion> {
    static constexpr const char* kClass = "SphereRegion";
    static void visit(SphereRegion& r, auto&& field) {
        auto& [center, radius] = r;
        field("center", center);
        field("radius", radius);
    }
};

template <>
struct Fields<HalfSpaceRegion> {
    static constexpr const char* kClass = "HalfSpaceRegion";
    static void visit(HalfSpaceRegion& r, auto&& field) {
        auto& [normal, offset] = r;
        field("normal", normal);
        field("offset", offset);
    }
};

template <>
struct Fields<Keyframe> {
    static constexpr const char* kClass = "Keyframe";
    static void visit(Keyframe& k, auto&& field) {
        auto& [time, move, turn, scale] = k;
        field("time", time);
        field("move", move);
        field("turn", turn);
        field("scale", scale);
    }
};

template <>
struct Fields<DragDescription> {
    static constexpr const char* kClass = "Drag";
    static void visit(DragDescription& d, auto&& field) {
        auto& [move, turn] = d;
        field("move", move);
        field("turn", turn);
    }
};

template <>
struct Fields<HandleDescription> {
    static constexpr const char* kClass = "Handle";
    static void visit(HandleDescription& h, auto&& field) {
        auto& [region, pivot, interpolation, release, keyframes, line, drag, when_blocked] = h;
        field("region", region);
        field("pivot", pivot);
        field("interpolation", interpolation);
        field("release", release);
        field("keyframes", keyframes);
        field("drag", drag);
        field("when_blocked", when_blocked);
        field("line", line);
    }
};

template <>
struct Fields<ForceLoad> {
    static constexpr const char* kClass = "Force";
    static void visit(ForceLoad& f, auto&& field) {
        auto& [sum] = f;
        field("sum", sum);
    }
};

template <>
struct Fields<TractionLoad> {
    static constexpr const char* kClass = "Traction";
    static void visit(TractionLoad& t, auto&& field) {
        auto& [stress] = t;
        field("stress", stress);
    }
};

template <>
struct Fields<PressureLoad> {
    static constexpr const char* kClass = "Pressure";
    static void visit(PressureLoad& p, auto&& field) {
        auto& [pressure] = p;
        field("pressure", pressure);
    }
};

template <>
struct Fields<LoadDescription> {
    static constexpr const char* kClass = "Load";
    static void visit(LoadDescription& l, auto&& field) {
        auto& [region, kind, from, until, line] = l;
        field("region", region);
        field("kind", kind);
        field("start", from);  // `from` is a word of Python's own
        field("until", until);
        field("line", line);
    }
};

template <>
struct Fields<TetAttribute> {
    static constexpr const char* kClass = "TetAttribute";
    static void visit(TetAttribute& a, auto&& field) {
        auto& [number] = a;
        field("number", number);
    }
};

template <>
struct Fields<PartDescription> {
    static constexpr const char* kClass = "Part";
    static void visit(PartDescription& p, auto&& field) {
        auto& [where, material, line] = p;
        field("where", where);
        field("material", material);
        field("line", line);
    }
};

template <>
struct Fields<StartDescription> {
    static constexpr const char* kClass = "Start";
    static void visit(StartDescription& s, auto&& field) {
        auto& [scale, scatter] = s;
        field("scale", scale);
        field("scatter", scatter);
    }
};

template <>
struct Fields<ObjectDescription> {
    static constexpr const char* kClass = "Object";
    static void visit(ObjectDescription& o, auto&& field) {
        auto& [name, shape, mesher, material, position, rotation, scale, velocity, spin, start, pins, handles,
               loads, color, line, parts, skin] = o;
        field("name", name);
        field("shape", shape);
        field("mesher", mesher);
        field("material", material);
        field("position", position);
        field("rotation", rotation);
        field("scale", scale);
        field("velocity", velocity);
        field("spin", spin);
        field("start", start);
        field("pins", pins);
        field("handles", handles);
        field("loads", loads);
        field("color", color);
        field("parts", parts);
        field("skin", skin);
        field("line", line);
    }
};

template <>
struct Fields<PlaneCollider> {
    static constexpr const char* kClass = "Plane";
    static void visit(PlaneCollider& p, auto&& field) {
        auto& [normal, offset] = p;
        field("normal", normal);
        field("offset", offset);
    }
};

template <>
struct Fields<ColliderDescription> {
    static constexpr const char* kClass = "Collider";
    static void visit(ColliderDescription& c, auto&& field) {
        auto& [shape, position, rotation, friction, restitution, keyframes, interpolation, pivot,
               surface_velocity, name, scale, when_blocked] = c;
        field("shape", shape);
        field("position", position);
        field("rotation", rotation);
        field("friction", friction);
        field("restitution", restitution);
        field("keyframes", keyframes);
        field("interpolation", interpolation);
        field("pivot", pivot);
        field("surface_velocity", surface_velocity);
        field("name", name);
        field("scale", scale);
        field("when_blocked", when_blocked);
    }
};

template <>
struct Fields<CameraDescription> {
    static constexpr const char* kClass = "Camera";
    static void visit(CameraDescription& c, auto&& field) {
        auto& [eye, target, field_of_view] = c;
        field("eye", eye);
        field("target", target);
        field("field_of_view", field_of_view);
    }
};

template <>
struct Fields<Scene> {
    static constexpr const char* kClass = "Scene";
    static void visit(Scene& s, auto&& field) {
        auto& [file, simulation, collision, materials, objects, colliders, camera] = s;
        field("file", file);
        field("simulation", simulation);
        field("collision", collision);
        field("materials", materials);
        field("objects", objects);
        field("colliders", colliders);
        field("camera", camera);
    }
};

/// The names of an enumeration's values, as in scene files.
template <class Enum>
struct Names;

template <>
struct Names<SolverKind> {
    static constexpr std::array<std::pair<const char*, SolverKind>, 5> kAll{
        {{"explicit_euler", SolverKind::explicit_euler},
         {"semi_implicit_euler", SolverKind::semi_implicit_euler},
         {"midpoint", SolverKind::midpoint},
         {"rk4", SolverKind::rk4},
         {"vbd", SolverKind::vbd}}};
};
template <>
struct Names<ForceMethod> {
    static constexpr std::array<std::pair<const char*, ForceMethod>, 2> kAll{
        {{"divide_and_merge", ForceMethod::divide_and_merge}, {"fused", ForceMethod::fused}}};
};
template <>
struct Names<BroadPhase> {
    static constexpr std::array<std::pair<const char*, BroadPhase>, 4> kAll{
        {{"none", BroadPhase::none},
         {"boxes", BroadPhase::boxes},
         {"hierarchy", BroadPhase::hierarchy},
         {"depth", BroadPhase::depth}}};
};
template <>
struct Names<CollisionDetection> {
    static constexpr std::array<std::pair<const char*, CollisionDetection>, 2> kAll{
        {{"discrete", CollisionDetection::discrete}, {"continuous", CollisionDetection::continuous}}};
};
template <>
struct Names<CollisionResponse> {
    static constexpr std::array<std::pair<const char*, CollisionResponse>, 2> kAll{
        {{"restore", CollisionResponse::restore}, {"contact", CollisionResponse::contact}}};
};
template <>
struct Names<MaterialModel> {
    static constexpr std::array<std::pair<const char*, MaterialModel>, 2> kAll{
        {{"mass_spring", MaterialModel::mass_spring}, {"neo_hookean", MaterialModel::neo_hookean}}};
};
template <>
struct Names<MesherKind> {
    static constexpr std::array<std::pair<const char*, MesherKind>, 3> kAll{
        {{"auto", MesherKind::automatic}, {"tetgen", MesherKind::tetgen}, {"lattice", MesherKind::lattice}}};
};
template <>
struct Names<Interpolation> {
    static constexpr std::array<std::pair<const char*, Interpolation>, 2> kAll{
        {{"linear", Interpolation::linear}, {"smooth", Interpolation::smooth}}};
};
template <>
struct Names<WhenBlocked> {
    static constexpr std::array<std::pair<const char*, WhenBlocked>, 2> kAll{
        {{"goes_on", WhenBlocked::goes_on}, {"stops", WhenBlocked::stops}}};
};

}  // namespace gelatin::python
