#include "model/scene/scene_writer.h"

#include <fmt/format.h>

#include <iterator>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"
#include "model/scene/value_text.h"
#include "model/setting_names.h"

namespace gelatin {
namespace {

/// Keys and values, what is as usual left out: the lines of a table, or an inline one.
class Table {
public:
    template <class T>
    Table& add(const char* key, const T& value) {
        return add_text(key, text_of(value));
    }
    template <class T>
    Table& add(const char* key, const std::optional<T>& value) {
        return value ? add(key, *value) : *this;
    }
    template <class T>
    Table& add_unless(const T& usual, const char* key, const T& value) {
        return value == usual ? *this : add(key, value);
    }
    Table& add_text(const char* key, const std::string& text) {
        texts_.push_back(fmt::format("{} = {}", key, text));
        return *this;
    }

    bool is_empty() const { return texts_.empty(); }
    std::string lines() const { return texts_.empty() ? "" : fmt::format("{}\n", fmt::join(texts_, "\n")); }
    std::string in_line() const { return fmt::format("{{ {} }}", fmt::join(texts_, ", ")); }

private:
    std::vector<std::string> texts_;
};

struct ShapeTable {
    std::filesystem::path folder;  // of the file that is written

    Table operator()(const SphereShape& s) const {
        return Table().add("sphere", s.radius).add("frequency", s.frequency);
    }
    Table operator()(const BoxShape& s) const {
        return Table().add("box", s.size).add("segments", s.segments);
    }
    Table operator()(const CapsuleShape& s) const {
        return Table().add("capsule", s.radius).add("length", s.length).add("frequency", s.frequency);
    }
    Table operator()(const TextShape& s) const {
        return Table().add("text", s.text).add("depth", s.depth).add("size", s.size).add("font", s.font);
    }
    // From the new file's place.
    Table operator()(const FileShape& s) const {
        return Table().add("file", std::filesystem::proximate(s.file, folder).string());
    }
    Table operator()(const MeshShape&) const {
        throw InvalidInput(
            "a scene with a mesh in memory cannot be written: scene files name files of meshes");
    }
};

std::string list_of_points(const glm::dvec3& first, const glm::dvec3& second) {
    return fmt::format("[{}, {}]", text_of(first), text_of(second));
}

Table table_of(const Region& region) {
    if (const auto* box = std::get_if<BoxRegion>(&region))
        return Table().add_text("box", list_of_points(box->min, box->max));
    if (const auto* sphere = std::get_if<SphereRegion>(&region))
        return Table().add("sphere", sphere->center).add("radius", sphere->radius);
    const auto& half_space = std::get<HalfSpaceRegion>(region);
    return Table().add("plane", half_space.normal).add("offset", half_space.offset);
}

Table table_of(const MesherSettings& mesher) {
    const MesherSettings usual;
    Table table;
    if (mesher.kind == MesherKind::tetgen) table.add("kind", "tetgen");
    if (mesher.kind == MesherKind::lattice) table.add("kind", "lattice");
    table.add_unless(usual.quality, "quality", mesher.quality);
    table.add("max_volume", mesher.max_volume);
    table.add_unless(usual.time_limit, "time_limit", mesher.time_limit);
    return table.add("nodes", mesher.nodes).add("cell_size", mesher.cell_size);
}

Table table_of(const Keyframe& keyframe) {
    const Keyframe usual;
    return Table()
        .add("time", keyframe.time)
        .add_unless(usual.move, "move", keyframe.move)
        .add_unless(usual.turn, "turn", keyframe.turn)
        .add_unless(usual.scale, "scale", keyframe.scale);
}

Table table_of(const MotorKeyframe& keyframe) {
    return Table()
        .add("time", keyframe.time)
        .add("speed", keyframe.speed)
        .add("position", keyframe.position)
        .add("force", keyframe.force);
}

Table table_of(const CavityKeyframe& keyframe) {
    return Table()
        .add("time", keyframe.time)
        .add("pressure", keyframe.pressure)
        .add("amount", keyframe.amount);
}

// [{ ... }, { ... }]
template <class Item>
std::string list_of_tables(const std::vector<Item>& items) {
    std::vector<std::string> texts;
    for (const Item& item : items) texts.push_back(table_of(item).in_line());
    return fmt::format("[{}]", fmt::join(texts, ", "));
}

void add_timing(double start, double speed, bool loop, Table& table) {
    table.add_unless(0.0, "start", start).add_unless(1.0, "speed", speed).add_unless(false, "loop", loop);
}

Table table_of(const AnimationDescription& animation, const std::filesystem::path& folder) {
    Table table;
    if (const auto* clip = std::get_if<AnimationClip>(&animation.source)) table.add("clip", clip->name);
    if (const auto* files = std::get_if<AnimationFiles>(&animation.source))
        table.add("files", std::filesystem::proximate(files->pattern, folder).string())
            .add("rate", files->rate);
    if (std::holds_alternative<AnimationFrames>(animation.source))
        throw InvalidInput("a scene with vertices in memory cannot be written: scene files name files");
    if (std::holds_alternative<AnimationByProgram>(animation.source)) return table.add("by_program", true);
    add_timing(animation.start, animation.speed, animation.loop, table);
    return table;
}

Table table_of(const SkeletonDescription& skeleton, const std::filesystem::path& folder) {
    Table table;
    table.add("file", std::filesystem::proximate(skeleton.file, folder).string());
    table.add("radius", skeleton.radius).add_unless(std::string(), "clip", skeleton.clip);
    add_timing(skeleton.start, skeleton.speed, skeleton.loop, table);
    return table;
}

Table table_of(const HandleDescription& handle, const std::filesystem::path& folder) {
    Table table;
    if (handle.skeleton) {
        table.add_text("skeleton", table_of(*handle.skeleton, folder).in_line());
    } else {
        table.add_text("region", table_of(handle.region).in_line());
    }
    table.add("pivot", handle.pivot);
    if (handle.interpolation == Interpolation::smooth) table.add("interpolation", "smooth");
    table.add("release", handle.release);
    if (!handle.keyframes.empty()) table.add_text("keyframes", list_of_tables(handle.keyframes));
    if (handle.when_blocked == WhenBlocked::stops) table.add("when_blocked", "stops");
    const DragDescription usual;
    Table drag;
    drag.add_unless(usual.move, "move", handle.drag.move).add_unless(usual.turn, "turn", handle.drag.turn);
    if (!drag.is_empty()) table.add_text("drag", drag.in_line());
    return table;
}

Table table_of(const LoadDescription& load) {
    Table table;
    table.add_text("region", table_of(load.region).in_line());
    if (const auto* force = std::get_if<ForceLoad>(&load.kind)) table.add("force", force->sum);
    if (const auto* traction = std::get_if<TractionLoad>(&load.kind)) table.add("traction", traction->stress);
    if (const auto* pressure = std::get_if<PressureLoad>(&load.kind))
        table.add("pressure", pressure->pressure);
    return table.add("from", load.from).add("until", load.until);
}

Table table_of(const CavityDescription& cavity) {
    const CavityDescription usual;
    Table table;
    if (!cavity.name.empty()) table.add("name", cavity.name);
    if (cavity.region) table.add_text("region", table_of(*cavity.region).in_line());
    if (cavity.law == GasLaw::constant) table.add("law", "constant");
    table.add_unless(usual.pressure, "pressure", cavity.pressure)
        .add_unless(usual.amount, "amount", cavity.amount)
        .add_unless(usual.ambient, "ambient", cavity.ambient);
    if (!cavity.keyframes.empty()) table.add_text("keyframes", list_of_tables(cavity.keyframes));
    return table;
}

Table table_of(const PartDescription& part) {
    Table table;
    if (const auto* region = std::get_if<Region>(&part.where)) {
        table.add_text("region", table_of(*region).in_line());
    } else {
        table.add("attribute", std::get<TetAttribute>(part.where).number);
    }
    return table.add("material", part.material);
}

Table table_of(const ObjectDescription& object, const std::filesystem::path& folder) {
    const ObjectDescription usual;
    Table table;
    table.add("name", object.name);
    table.add_text("shape", std::visit(ShapeTable{folder}, object.shape).in_line());
    if (const Table mesher = table_of(object.mesher); !mesher.is_empty())
        table.add_text("mesher", mesher.in_line());
    table.add("material", object.material)
        .add_unless(usual.scale, "scale", object.scale)
        .add_unless(usual.rotation, "rotation", object.rotation);
    if (object.up) table.add("up", name_of(*object.up));
    table.add_unless(usual.position, "position", object.position)
        .add_unless(usual.velocity, "velocity", object.velocity)
        .add_unless(usual.spin, "spin", object.spin);
    Table start;
    start.add_unless(usual.start.scale, "scale", object.start.scale)
        .add_unless(usual.start.scatter, "scatter", object.start.scatter);
    if (!start.is_empty()) table.add_text("start", start.in_line());
    if (!object.pins.empty()) table.add_text("pins", list_of_tables(object.pins));
    if (object.rigid) table.add("mass", object.rigid->mass).add("inertia", object.rigid->inertia);
    return table.add("color", object.color).add_unless(usual.skin, "skin", object.skin);
}

Table table_of(const SimulationSettings& s) {
    Table table;
    table.add("solver", name_of(s.solver)).add("forces", name_of(s.forces));
    table.add("frame_rate", s.frame_rate).add("substeps", s.substeps);
    table.add("iterations", s.iterations);
    return table.add("gravity", s.gravity).add("frames", s.frames).add("sleep", s.sleep);
}

Table table_of(const CollisionSettings& c) {
    Table table;
    table.add("broad_phase", name_of(c.broad_phase)).add("detection", name_of(c.detection));
    if (c.response) table.add("response", name_of(*c.response));
    if (c.self_collision) table.add("self_collision", *c.self_collision);
    table.add("proximity_radius", c.proximity_radius);
    return table.add("friction", c.friction).add("restitution", c.restitution);
}

Table table_of(const Material& material) {
    Table table;
    table.add("name", material.name);
    if (material.model == MaterialModel::neo_hookean) table.add("model", "neo_hookean");
    table.add("youngs_modulus", material.youngs_modulus).add("density", material.density);
    table.add("poisson_ratio", material.poisson_ratio).add("damping", material.damping);
    if (material.springs) {
        std::vector<std::string> names;
        for (const std::string& kind : kind_names(*material.springs)) names.push_back(text_of(kind));
        table.add_text("springs", fmt::format("[{}]", fmt::join(names, ", ")));
    }
    table.add("friction", material.friction).add("thickness", material.thickness);
    table.add_unless(1.0, "contact_stiffness", material.contact_stiffness);
    return table.add("restitution", material.restitution);
}

Table table_of(const MaterialPair& pair) {
    Table table;
    table.add_text("materials", fmt::format("[{}, {}]", text_of(pair.first), text_of(pair.second)));
    table.add("friction", pair.friction).add("contact_stiffness", pair.contact_stiffness);
    return table.add("restitution", pair.restitution);
}

Table table_of(const ColliderDescription& collider, const std::filesystem::path& folder) {
    const ColliderDescription usual;
    Table table;
    if (!collider.name.empty()) table.add("name", collider.name);
    if (const auto* plane = std::get_if<PlaneCollider>(&collider.shape)) {
        table.add_text("shape", Table().add("plane", plane->normal).add("offset", plane->offset).in_line());
    } else {
        table.add_text("shape", std::visit(ShapeTable{folder}, std::get<Shape>(collider.shape)).in_line());
        table.add("position", collider.position).add("rotation", collider.rotation);
        if (collider.up) table.add("up", name_of(*collider.up));
    }
    table.add_unless(usual.scale, "scale", collider.scale);
    table.add("friction", collider.friction).add("restitution", collider.restitution);
    if (!collider.keyframes.empty()) table.add_text("keyframes", list_of_tables(collider.keyframes));
    if (collider.interpolation == Interpolation::smooth) table.add("interpolation", "smooth");
    if (collider.when_blocked == WhenBlocked::stops) table.add("when_blocked", "stops");
    if (collider.animation) table.add_text("animation", table_of(*collider.animation, folder).in_line());
    return table.add("pivot", collider.pivot)
        .add_unless(usual.surface_velocity, "surface_velocity", collider.surface_velocity);
}

Table table_of(const AttachedUniversal& universal) {
    return Table().add("point", universal.at).add("own", universal.own).add("of_other", universal.of_other);
}

Table table_of(const JointSpring& spring) {
    return Table()
        .add_unless(0.0, "stiffness", spring.stiffness)
        .add_unless(0.0, "damping", spring.damping)
        .add("rest", spring.rest);
}

Table table_of(const JointMotor& motor) {
    Table table;
    table.add("speed", motor.speed).add("position", motor.position).add("force", motor.force);
    if (!motor.keyframes.empty()) table.add_text("keyframes", list_of_tables(motor.keyframes));
    return table;
}

Table table_of(const AttachmentDescription& attachment) {
    Table table;
    if (!attachment.name.empty()) table.add("name", attachment.name);
    table.add("object", attachment.object);
    if (!attachment.to.empty()) table.add("to", attachment.to);
    if (const auto* region = std::get_if<Region>(&attachment.where))
        table.add_text("region", table_of(*region).in_line());
    if (const auto* point = std::get_if<AttachedPoint>(&attachment.where)) table.add("point", point->at);
    if (const auto* line = std::get_if<AttachedLine>(&attachment.where))
        table.add_text("line", list_of_points(line->from, line->to));
    if (const auto* rail = std::get_if<AttachedRail>(&attachment.where))
        table.add_text("rail", list_of_points(rail->from, rail->to));
    if (const auto* universal = std::get_if<AttachedUniversal>(&attachment.where))
        table.add_text("universal", table_of(*universal).in_line());
    if (const auto* distance = std::get_if<AttachedDistance>(&attachment.where))
        table.add_text("distance", list_of_points(distance->from, distance->to));
    table.add_unless(0.0, "compliance", attachment.compliance)
        .add("break_force", attachment.break_force)
        .add("limits", attachment.limits);
    if (attachment.spring) table.add_text("spring", table_of(*attachment.spring).in_line());
    if (attachment.motor) table.add_text("motor", table_of(*attachment.motor).in_line());
    return table;
}

}  // namespace

std::string to_toml(const Scene& scene, const std::filesystem::path& folder) {
    std::string text;
    if (scene.up != Axis::y) text = Table().add("up", name_of(scene.up)).lines();
    const auto add = [&](const std::string& head, const Table& table) {
        text += fmt::format("{}{}\n{}", text.empty() ? "" : "\n", head, table.lines());
    };
    add("[simulation]", table_of(scene.simulation));
    add("[collision]", table_of(scene.collision));
    for (const MaterialPair& pair : scene.collision.pairs) add("[[collision.pair]]", table_of(pair));
    if (const auto& camera = scene.camera) {
        add("[camera]", Table()
                            .add("eye", camera->eye)
                            .add("target", camera->target)
                            .add("field_of_view", camera->field_of_view));
    }
    for (const Material& material : scene.materials) add("[[material]]", table_of(material));
    for (const ObjectDescription& object : scene.objects) {
        const std::string name = table_name(object);
        add("[[" + name + "]]", table_of(object, folder));
        for (const PartDescription& part : object.parts) add("[[object.part]]", table_of(part));
        for (const HandleDescription& handle : object.handles)
            add("[[object.handle]]", table_of(handle, folder));
        for (const CavityDescription& cavity : object.cavities) add("[[object.cavity]]", table_of(cavity));
        for (const LoadDescription& load : object.loads) add("[[" + name + ".load]]", table_of(load));
    }
    for (const ColliderDescription& collider : scene.colliders)
        add("[[collider]]", table_of(collider, folder));
    return text + to_toml(scene.attachments);
}

std::string to_toml(const std::vector<AttachmentDescription>& attachments) {
    std::string text;
    for (const AttachmentDescription& attachment : attachments)
        text += "\n[[attachment]]\n" + table_of(attachment).lines();
    return text;
}

void save_scene(const std::filesystem::path& file, const Scene& scene) {
    write_file(file, to_toml(scene, std::filesystem::absolute(file).parent_path()));
}

}  // namespace gelatin
