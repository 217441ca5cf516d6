#include "model/scene/validate_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "mesh/mesh_in_memory.h"
#include "model/scene/names.h"
#include "model/scene/validate_animation.h"
#include "model/scene/validate_cavities.h"
#include "model/setting_names.h"

namespace gelatin {
namespace {

// Meshes past these sizes are slips: 20 * 500^2 faces are five million.
constexpr Limit kSphereFrequency{"from 1 to 500", [](double v) { return v >= 1.0 && v <= 500.0; }};
constexpr Limit kCapsuleFrequency{"from 2 to 500", [](double v) { return v >= 2.0 && v <= 500.0; }};
constexpr Limit kSegments{"from 1 to 1000", [](double v) { return v >= 1.0 && v <= 1000.0; }};
constexpr Limit kNodes{"from 10 to 1000000", [](double v) { return v >= 10.0 && v <= 1e6; }};
constexpr Limit kQuality{"greater than 1", [](double v) { return v > 1.0; }};

struct ShapeCheck {
    const ValueChecks& checks;
    FieldPath field;

    void operator()(const SphereShape& shape) const {
        checks.check(field / "sphere", shape.radius, kPositive);
        checks.check(field / "frequency", shape.frequency, kSphereFrequency);
    }
    void operator()(const BoxShape& shape) const {
        checks.check(field / "box", shape.size, kPositive);
        checks.check(field / "segments", shape.segments, kSegments);
    }
    void operator()(const CapsuleShape& shape) const {
        checks.check(field / "capsule", shape.radius, kPositive);
        checks.check(field / "length", shape.length, kPositive);
        checks.check(field / "frequency", shape.frequency, kCapsuleFrequency);
    }
    void operator()(const TextShape& shape) const {
        checks.check_text(field / "text", shape.text);
        checks.check(field / "depth", shape.depth, kPositive);
        checks.check(field / "size", shape.size, kPositive);
        checks.check_text(field / "font", shape.font);
    }
    void operator()(const FileShape& shape) const {
        checks.check_text(field / "file", shape.file.filename().string());
    }
    void operator()(const MeshShape& shape) const {
        if (!shape.mesh) return checks.fail(field / "mesh", "null", "must be there");
        const std::optional<MeshProblem> problem = find_problem(*shape.mesh);
        if (!problem) return;
        FieldPath where = field / "mesh";
        if (*problem->array != '\0') where = where / problem->array;
        checks.fail(problem->index ? where[*problem->index] : where, problem->value, problem->problem);
    }
};

class ColliderCheck {
public:
    ColliderCheck(const ValueChecks& checks, bool has_contact) : checks_(checks), has_contact_(has_contact) {}

    void run(const FieldPath& field, const ColliderDescription& collider) const {
        if (const auto* plane = std::get_if<PlaneCollider>(&collider.shape)) {
            checks_.check_direction(field / "shape" / "plane", plane->normal);
            checks_.check(field / "shape" / "offset", plane->offset);
        } else {
            std::visit(ShapeCheck{checks_, field / "shape"}, std::get<Shape>(collider.shape));
        }
        checks_.check(field / "position", collider.position);
        checks_.check(field / "rotation", collider.rotation);
        checks_.check(field / "scale", collider.scale, kPositive);
        checks_.check(field / "friction", collider.friction, kNotNegative);
        checks_.check(field / "restitution", collider.restitution, kFraction);
        check_keyframes(checks_, field / "keyframes", collider.keyframes);
        checks_.check(field / "pivot", collider.pivot);
        checks_.check(field / "surface_velocity", collider.surface_velocity);
        if (std::holds_alternative<PlaneCollider>(collider.shape)) check_plane(field, collider);
        if (!has_contact_) check_solid(field, collider);
        check_when_blocked(checks_, field / "when_blocked", collider.when_blocked,
                           !collider.keyframes.empty() || collider.animation, has_contact_);
        if (!collider.animation) return;
        if (const auto* shape = std::get_if<Shape>(&collider.shape))
            check_animation(checks_, field / "animation", *collider.animation, *shape);
    }

private:
    void check_plane(const FieldPath& field, const ColliderDescription& collider) const {
        const std::string placed = "a plane has none: its shape's normal and offset place it";
        const auto refuse_vector = [&](const char* key, const glm::dvec3& value, const std::string& why) {
            if (value != glm::dvec3(0.0)) checks_.fail(field / key, text_of(value), why);
        };
        refuse_vector("position", collider.position, placed);
        refuse_vector("rotation", collider.rotation, placed);
        if (collider.scale != 1.0) checks_.fail(field / "scale", text_of(collider.scale), placed);
        if (collider.up) checks_.fail(field / "up", text_of(name_of(*collider.up)), placed);
        const std::string rests = "a plane does not move: a box can";
        if (!collider.keyframes.empty()) checks_.fail(field / "keyframes", "[{...}]", rests);
        if (collider.animation) checks_.fail(field / "animation", "", rests);
        refuse_vector("surface_velocity", collider.surface_velocity, rests);
        if (collider.when_blocked == WhenBlocked::stops)
            checks_.fail(field / "when_blocked", text_of("stops"), rests);
    }

    // Colliders as the paper has them: solid, of the kinds that nodes are easily pushed out of, and at rest.
    void check_solid(const FieldPath& field, const ColliderDescription& collider) const {
        if (const auto* shape = std::get_if<Shape>(&collider.shape)) {
            if (const auto* text = std::get_if<TextShape>(shape))
                checks_.fail(field / "shape" / "text", text_of(text->text), kNeedsContact);
            if (const auto* file = std::get_if<FileShape>(shape))
                checks_.fail(field / "shape" / "file", text_of(file->file.string()), kNeedsContact);
            if (std::holds_alternative<MeshShape>(*shape))
                checks_.fail(field / "shape" / "mesh", {}, kNeedsContact);
        }
        if (!collider.keyframes.empty()) checks_.fail(field / "keyframes", "[{...}]", kNeedsContact);
        if (collider.animation) checks_.fail(field / "animation", "", kNeedsContact);
        if (collider.surface_velocity != glm::dvec3(0.0))
            checks_.fail(field / "surface_velocity", text_of(collider.surface_velocity), kNeedsContact);
        if (collider.scale != 1.0) checks_.fail(field / "scale", text_of(collider.scale), kNeedsContact);
    }

    const ValueChecks& checks_;
    bool has_contact_;
};

class ObjectCheck {
public:
    ObjectCheck(const ValueChecks& checks, const Scene& scene)
        : checks_(checks),
          materials_(scene.materials),
          has_contact_(scene.has_contact()),
          solver_(scene.simulation.solver) {}

    void run(const FieldPath& field, const ObjectDescription& object) const {
        checks_.check_text(field / "name", object.name);
        std::visit(ShapeCheck{checks_, field / "shape"}, object.shape);
        check_mesher(field / "mesher", object.mesher);
        const Material& material = find(field, object.material);
        for (std::size_t p = 0; p < object.parts.size(); ++p)
            check_part((field / "part")[p], object.parts[p], material);
        checks_.check(field / "position", object.position);
        checks_.check(field / "rotation", object.rotation);
        checks_.check(field / "scale", object.scale, kPositive);
        checks_.check(field / "velocity", object.velocity);
        checks_.check(field / "spin", object.spin);
        checks_.check(field / "start" / "scale", object.start.scale, kNotNegative);
        checks_.check(field / "start" / "scatter", object.start.scatter, kNotNegative);
        for (std::size_t p = 0; p < object.pins.size(); ++p)
            check_region(checks_, (field / "pins")[p], object.pins[p]);
        for (std::size_t h = 0; h < object.handles.size(); ++h)
            check_handle(checks_, (field / "handle")[h], object.handles[h], has_contact_);
        for (std::size_t l = 0; l < object.loads.size(); ++l)
            check_load(checks_, (field / "load")[l], object.loads[l]);
        check_cavities(checks_, field / "cavity", object.cavities, solver_);
        checks_.check(field / "color", object.color, kFraction);
        if (object.rigid) check_rigid(field, object, *object.rigid);
    }

private:
    void check_rigid(const FieldPath& field, const ObjectDescription& object,
                     const RigidDescription& rigid) const {
        if (!is_implicit(solver_)) checks_.fail(field, "", "needs simulation.solver = \"implicit\"");
        checks_.check(field / "mass", rigid.mass, kPositive);
        checks_.check(field / "inertia", rigid.inertia, kPositive);
        if (rigid.inertia) check_inertia(field / "inertia", *rigid.inertia);
        const ObjectDescription usual;
        const auto refuse = [&](const char* key, bool is_there, const char* problem) {
            if (is_there) checks_.fail(field / key, "", problem);
        };
        refuse("pins", !object.pins.empty(), kHoldsNoNodes);
        refuse("handle", !object.handles.empty(), kHoldsNoNodes);
        refuse("mesher", object.mesher != usual.mesher, kHasNoTets);
        refuse("part", !object.parts.empty(), kHasNoTets);
        refuse("start",
               object.start.scale != usual.start.scale || object.start.scatter != usual.start.scatter,
               kHasNoTets);
        refuse("skin", object.skin != usual.skin, kHasNoTets);
        refuse("cavity", !object.cavities.empty(), kHasNoTets);
    }

    // Ixx + Iyy - Izz is twice the integral of density * z^2, and so on.
    void check_inertia(const FieldPath& field, const glm::dvec3& inertia) const {
        constexpr double kRounding = 1e-12;  // of a flat body one is the sum of the others
        for (int k = 0; k < 3; ++k) {
            const double others = inertia[(k + 1) % 3] + inertia[(k + 2) % 3];
            if (inertia[k] <= (1.0 + kRounding) * others) continue;
            checks_.fail(field[static_cast<std::size_t>(k)], text_of(inertia[k]),
                         fmt::format("must be at most the sum of the other two, {}", others));
        }
    }

    void check_mesher(const FieldPath& field, const MesherSettings& mesher) const {
        checks_.check(field / "quality", mesher.quality, kQuality);
        checks_.check(field / "max_volume", mesher.max_volume, kPositive);
        checks_.check(field / "time_limit", mesher.time_limit, kPositive);
        checks_.check(field / "nodes", mesher.nodes, kNodes);
        checks_.check(field / "cell_size", mesher.cell_size, kPositive);
        check_sizes(field, mesher);
    }

    void check_sizes(const FieldPath& field, const MesherSettings& mesher) const {
        const auto refuse = [&](const char* key, const std::string& value, const char* problem) {
            checks_.fail(field / key, value, problem);
        };
        constexpr const char* kOneSize = "must not be given with another of nodes, cell_size and max_volume";
        if (mesher.cell_size && (mesher.nodes || mesher.max_volume))
            refuse("cell_size", text_of(*mesher.cell_size), kOneSize);
        else if (mesher.nodes && mesher.max_volume)
            refuse("nodes", text_of(*mesher.nodes), kOneSize);
        if (mesher.kind == MesherKind::tetgen && mesher.cell_size)
            refuse("cell_size", text_of(*mesher.cell_size),
                   "is only for the lattice, not for kind = \"tetgen\"; nodes and max_volume are for both");
        if (mesher.kind == MesherKind::lattice && mesher.quality != MesherSettings().quality)
            refuse("quality", text_of(mesher.quality), "is only for TetGen, not for kind = \"lattice\"");
    }

    void check_part(const FieldPath& field, const PartDescription& part, const Material& whole) const {
        if (const auto* region = std::get_if<Region>(&part.where))
            check_region(checks_, field / "region", *region);
        const Material& material = find(field, part.material);
        if (material.model != whole.model || material.springs != whole.springs) {
            checks_.fail(
                field / "material", text_of(part.material),
                fmt::format("must have the same model and springs as the object's own, '{}'", whole.name));
        }
    }

    // The material that the body or part at `field` names.
    const Material& find(const FieldPath& field, const std::string& name) const {
        const auto found = std::find_if(materials_.begin(), materials_.end(),
                                        [&](const Material& material) { return material.name == name; });
        if (found == materials_.end()) refuse_material(field, name);
        return *found;
    }

    void refuse_material(const FieldPath& field, const std::string& name) const {
        std::vector<std::string> names;
        for (const Material& material : materials_) names.push_back(material.name);
        if (name.empty()) {
            checks_.fail(field, "",
                         names.empty() ? "needs a material: the scene has no [[material]]"
                                       : "needs \"material\": one of " + join_names(names, "or"));
        }
        checks_.fail(field / "material", text_of(name),
                     fmt::format("no such material{}; {}", suggestion(name, names),
                                 names.empty() ? "the scene has none" : "there is " + join_names(names)));
    }

    const ValueChecks& checks_;
    const std::vector<Material>& materials_;
    bool has_contact_;
    SolverKind solver_;
};

}  // namespace

void check_objects(const ValueChecks& checks, const Scene& scene) {
    const ObjectCheck check(checks, scene);
    std::unordered_map<std::string_view, int> lines;  // by name
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const ObjectDescription& object = scene.objects[o];
        const FieldPath field(table_name(object), o);
        check.run(field, object);
        const auto [taken, is_new] = lines.emplace(object.name, object.line);
        if (!is_new) checks.fail(field / "name", text_of(object.name), name_taken("object", taken->second));
    }
    if (scene.objects.empty()) checks.fail({}, "", "has no objects: add an [[object]] or a [[rigid]]");
}

void check_colliders(const ValueChecks& checks, const Scene& scene) {
    const ColliderCheck check(checks, scene.has_contact());
    for (std::size_t c = 0; c < scene.colliders.size(); ++c)
        check.run(FieldPath("collider", c), scene.colliders[c]);
    check_optional_names(checks, FieldPath("collider"), "collider", scene.colliders);
}

}  // namespace gelatin
