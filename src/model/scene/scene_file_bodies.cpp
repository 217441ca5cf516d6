#include "model/scene/scene_file_bodies.h"

#include <algorithm>
#include <iterator>

#include "model/scene/field_path.h"
#include "model/scene/scene_file_animation.h"
#include "model/scene/scene_file_cavities.h"
#include "model/scene/scene_file_copies.h"
#include "model/scene/scene_file_drives.h"
#include "model/scene/scene_file_region.h"
#include "model/scene/validate_bodies.h"

namespace gelatin {
namespace {

// @param kind one of the table's keys
Shape read_shape(TableReader& reader, const std::string& kind, const std::filesystem::path& folder) {
    Shape result;
    if (kind == "sphere") {
        SphereShape shape;
        reader.read("sphere", shape.radius);
        reader.read("frequency", shape.frequency);
        result = shape;
    } else if (kind == "box") {
        BoxShape shape;
        reader.read("box", shape.size);
        reader.read("segments", shape.segments);
        result = shape;
    } else if (kind == "capsule") {
        CapsuleShape shape;
        reader.read("capsule", shape.radius);
        reader.read("length", shape.length);
        reader.read("frequency", shape.frequency);
        result = shape;
    } else if (kind == "text") {
        TextShape shape;
        reader.read("text", shape.text);
        reader.read("depth", shape.depth);
        reader.read("size", shape.size);
        reader.read("font", shape.font);
        result = shape;
    } else {
        std::string file;
        reader.read("file", file);
        result = FileShape{file.empty() ? std::filesystem::path() : folder / file};
    }
    return result;
}

Shape read_shape(TableReader reader, const std::filesystem::path& folder) {
    const std::string kind = reader.require_one_of({"sphere", "box", "capsule", "text", "file"});
    Shape shape = read_shape(reader, kind, folder);
    reader.finish();
    return shape;
}

std::optional<Axis> read_up(TableReader& reader) {
    if (!reader.has("up")) return {};
    Axis up{};
    reader.read("up", up, {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}});
    return up;
}

MesherSettings read_mesher(TableReader reader) {
    MesherSettings mesher;
    reader.read(
        "kind", mesher.kind,
        {{"auto", MesherKind::automatic}, {"tetgen", MesherKind::tetgen}, {"lattice", MesherKind::lattice}});
    reader.read("quality", mesher.quality);
    reader.read("max_volume", mesher.max_volume);
    reader.read("time_limit", mesher.time_limit);
    reader.read("nodes", mesher.nodes);
    reader.read("cell_size", mesher.cell_size);
    reader.finish();
    return mesher;
}

StartDescription read_start(TableReader reader) {
    StartDescription start;
    reader.read("scale", start.scale);
    reader.read("scatter", start.scatter);
    reader.finish();
    return start;
}

// An object that names no material has the scene's only one; empty where there is no such.
std::string read_material_name(TableReader& reader, const std::vector<Material>& materials) {
    if (!reader.has("material")) return materials.size() == 1 ? materials.front().name : "";
    std::string name;
    reader.read("material", name);
    return name;
}

PartDescription read_part(TableReader& reader, const std::vector<Material>& materials) {
    PartDescription part;
    part.line = reader.line();
    reader.require({"material"});
    if (reader.require_one_of({"region", "attribute"}) == "region") {
        part.where = read_region(*reader.table("region"));
    } else {
        TetAttribute attribute{};
        reader.read("attribute", attribute.number);
        part.where = attribute;
    }
    part.material = read_material_name(reader, materials);
    reader.finish();
    return part;
}

// What deformable and rigid objects share.
// @param table the name of the table, for messages
ObjectDescription read_body(TableReader& reader, const std::string& table,
                            const std::vector<Material>& materials, const std::filesystem::path& folder) {
    ObjectDescription object;
    object.line = reader.line();
    reader.require({"name", "shape"});
    reader.read("name", object.name);
    if (is_plain_name(object.name)) reader.set_path(table + "." + object.name);
    object.shape = read_shape(*reader.table("shape"), folder);
    object.material = read_material_name(reader, materials);
    reader.read("position", object.position);
    reader.read("rotation", object.rotation);
    object.up = read_up(reader);
    reader.read("scale", object.scale);
    reader.read("velocity", object.velocity);
    reader.read("spin", object.spin);
    for (TableReader& load : reader.tables("load")) object.loads.push_back(read_load(load));
    if (reader.has("color")) {
        glm::dvec3 color{};
        reader.read("color", color);
        object.color = color;
    }
    return object;
}

// The object, or its copies. Finishes the table.
std::vector<ObjectDescription> read_copies_of(TableReader& reader, const ObjectDescription& object) {
    const auto copies = reader.table("copies");
    reader.finish();
    if (copies) return read_copies(*copies, object);
    return {object};
}

std::vector<ObjectDescription> read_object(TableReader& reader, const std::vector<Material>& materials,
                                           const std::filesystem::path& folder) {
    ObjectDescription object = read_body(reader, "object", materials, folder);
    if (const auto mesher = reader.table("mesher")) object.mesher = read_mesher(*mesher);
    for (TableReader& part : reader.tables("part")) object.parts.push_back(read_part(part, materials));
    if (const auto start = reader.table("start")) object.start = read_start(*start);
    object.pins_line = reader.line_of("pins");
    for (TableReader& pin : reader.tables("pins")) object.pins.push_back(read_region(pin));
    for (TableReader& handle : reader.tables("handle")) object.handles.push_back(read_handle(handle, folder));
    for (TableReader& cavity : reader.tables("cavity")) object.cavities.push_back(read_cavity(cavity));
    reader.read("skin", object.skin);
    return read_copies_of(reader, object);
}

std::vector<ObjectDescription> read_rigid(TableReader& reader, const std::vector<Material>& materials,
                                          const std::filesystem::path& folder) {
    ObjectDescription object = read_body(reader, "rigid", materials, folder);
    RigidDescription& rigid = object.rigid.emplace();
    reader.read("mass", rigid.mass);
    if (reader.has("inertia")) reader.read("inertia", rigid.inertia.emplace(0.0));
    reader.refuse({"pins", "handle"}, kHoldsNoNodes);
    reader.refuse({"mesher", "part", "start", "skin", "cavity"}, kHasNoTets);
    return read_copies_of(reader, object);
}

ColliderDescription read_collider(TableReader& reader, const CollisionSettings& collision,
                                  const std::filesystem::path& folder) {
    ColliderDescription collider;
    collider.friction = collision.friction;
    collider.restitution = collision.restitution;
    collider.line = reader.line();
    reader.read_name("name", collider.name);
    if (is_plain_name(collider.name)) reader.set_path("collider." + collider.name);
    reader.require({"shape"});
    TableReader shape = *reader.table("shape");
    const std::string kind = shape.require_one_of({"plane", "box", "sphere", "capsule", "text", "file"});
    if (kind == "plane") {
        PlaneCollider plane;
        shape.read_direction("plane", plane.normal);
        shape.read("offset", plane.offset);
        collider.shape = plane;
    } else {
        collider.shape = read_shape(shape, kind, folder);
    }
    shape.finish();
    reader.read("position", collider.position);
    reader.read("rotation", collider.rotation);
    collider.up = read_up(reader);
    reader.read("scale", collider.scale);
    reader.read("friction", collider.friction);
    reader.read("restitution", collider.restitution);
    collider.keyframes = read_keyframes(reader);
    collider.interpolation = read_interpolation(reader);
    collider.when_blocked = read_when_blocked(reader);
    if (reader.has("pivot")) reader.read("pivot", collider.pivot.emplace(0.0));
    reader.read("surface_velocity", collider.surface_velocity);
    if (auto animation = reader.table("animation"))
        collider.animation = read_animation(std::move(*animation), folder);
    reader.finish();
    return collider;
}

// @param table the index of the table that they are in
void append(std::vector<ObjectDescription> objects, std::size_t table, ReadObjects& read) {
    read.tables.insert(read.tables.end(), objects.size(), table);
    std::move(objects.begin(), objects.end(), std::back_inserter(read.objects));
}

}  // namespace

ReadObjects read_objects(std::vector<TableReader> tables, const std::vector<Material>& materials,
                         const std::filesystem::path& folder) {
    ReadObjects read;
    for (std::size_t t = 0; t < tables.size(); ++t)
        append(read_object(tables[t], materials, folder), t, read);
    return read;
}

ReadObjects read_rigids(std::vector<TableReader> tables, const std::vector<Material>& materials,
                        const std::filesystem::path& folder) {
    ReadObjects read;
    for (std::size_t t = 0; t < tables.size(); ++t) append(read_rigid(tables[t], materials, folder), t, read);
    return read;
}

ReadObjects merge_objects(ReadObjects deformable, ReadObjects rigid) {
    ReadObjects merged;
    std::size_t d = 0, r = 0;
    while (d < deformable.tables.size() || r < rigid.tables.size()) {
        const bool is_rigid = d == deformable.tables.size() ||
                              (r < rigid.tables.size() && rigid.objects[r].line < deformable.objects[d].line);
        ReadObjects& from = is_rigid ? rigid : deformable;
        std::size_t& next = is_rigid ? r : d;
        merged.objects.push_back(std::move(from.objects[next]));
        merged.tables.push_back(from.tables[next++]);
    }
    return merged;
}

std::vector<ColliderDescription> read_colliders(std::vector<TableReader> tables,
                                                const CollisionSettings& collision,
                                                const std::filesystem::path& folder) {
    std::vector<ColliderDescription> colliders;
    for (TableReader& reader : tables) colliders.push_back(read_collider(reader, collision, folder));
    return colliders;
}

}  // namespace gelatin
