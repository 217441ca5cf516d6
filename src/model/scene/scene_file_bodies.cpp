#include "model/scene/scene_file_bodies.h"

#include <fmt/core.h>

#include <algorithm>
#include <unordered_map>

#include "model/scene/scene_file_copies.h"
#include "model/scene/scene_file_drives.h"
#include "model/scene/scene_file_region.h"

namespace gelatin {
namespace {

// Meshes past these sizes are slips: 20 * 500^2 faces are five million.
constexpr Limit kSphereFrequency{"from 1 to 500", [](double v) { return v >= 1.0 && v <= 500.0; }};
constexpr Limit kCapsuleFrequency{"from 2 to 500", [](double v) { return v >= 2.0 && v <= 500.0; }};
constexpr Limit kSegments{"from 1 to 1000", [](double v) { return v >= 1.0 && v <= 1000.0; }};
constexpr Limit kQuality{"greater than 1", [](double v) { return v > 1.0; }};

Shape read_shape(TableReader reader, const std::filesystem::path& folder) {
    const std::string kind = reader.require_one_of({"sphere", "box", "capsule", "text", "file"});
    Shape result;
    if (kind == "sphere") {
        SphereShape shape;
        reader.read("sphere", shape.radius, kPositive);
        reader.read("frequency", shape.frequency, kSphereFrequency);
        result = shape;
    } else if (kind == "box") {
        BoxShape shape;
        reader.read("box", shape.size, kPositive);
        reader.read("segments", shape.segments, kSegments);
        result = shape;
    } else if (kind == "capsule") {
        CapsuleShape shape;
        reader.read("capsule", shape.radius, kPositive);
        reader.read("length", shape.length, kPositive);
        reader.read("frequency", shape.frequency, kCapsuleFrequency);
        result = shape;
    } else if (kind == "text") {
        TextShape shape;
        reader.read("text", shape.text);
        reader.read("depth", shape.depth, kPositive);
        reader.read("size", shape.size, kPositive);
        reader.read("font", shape.font);
        result = shape;
    } else {
        std::string file;
        reader.read("file", file);
        result = FileShape{folder / file};
    }
    reader.finish();
    return result;
}

MesherSettings read_mesher(TableReader reader) {
    MesherSettings mesher;
    reader.read("kind", mesher.kind, {{"auto", MesherKind::automatic}, {"tetgen", MesherKind::tetgen}});
    reader.read("quality", mesher.quality, kQuality);
    reader.read("max_volume", mesher.max_volume, kPositive);
    reader.read("time_limit", mesher.time_limit, kPositive);
    reader.finish();
    return mesher;
}

StartDescription read_start(TableReader reader) {
    StartDescription start;
    reader.read("scale", start.scale, kNotNegative);
    reader.read("scatter", start.scatter, kNotNegative);
    reader.finish();
    return start;
}

// An object that names no material has the scene's only one.
std::string read_material_name(TableReader& reader, const std::vector<Material>& materials) {
    std::vector<std::string> names;
    for (const Material& material : materials) names.push_back(material.name);
    if (!reader.has("material")) {
        if (names.size() == 1) return names.front();
        reader.fail("", names.empty() ? "needs a material: the scene has no [[material]]"
                                      : "needs \"material\": one of " + join_names(names, "or"));
    }
    std::string name;
    reader.read("material", name);
    if (std::find(names.begin(), names.end(), name) != names.end()) return name;
    reader.fail("material",
                fmt::format("no such material{}; {}", suggestion(name, names),
                            names.empty() ? "the scene has none" : "there is " + join_names(names)));
}

PartDescription read_part(TableReader& reader, const std::vector<Material>& materials) {
    PartDescription part;
    part.line = reader.line();
    reader.require({"material"});
    if (reader.require_one_of({"region", "attribute"}) == "region") {
        part.where = read_region(*reader.table("region"));
    } else {
        TetAttribute attribute{};
        reader.read("attribute", attribute.number, kAnyNumber);
        part.where = attribute;
    }
    part.material = read_material_name(reader, materials);
    reader.finish();
    return part;
}

// The object, or its copies.
std::vector<ObjectDescription> read_object(TableReader& reader, const std::vector<Material>& materials,
                                           const std::filesystem::path& folder) {
    ObjectDescription object;
    object.line = reader.line();
    reader.require({"name", "shape"});
    reader.read("name", object.name);
    reader.set_path("object." + object.name);
    object.shape = read_shape(*reader.table("shape"), folder);
    if (const auto mesher = reader.table("mesher")) object.mesher = read_mesher(*mesher);
    object.material = read_material_name(reader, materials);
    for (TableReader& part : reader.tables("part")) object.parts.push_back(read_part(part, materials));
    reader.read("position", object.position);
    reader.read("rotation", object.rotation);
    reader.read("scale", object.scale, kPositive);
    reader.read("velocity", object.velocity);
    reader.read("spin", object.spin);
    if (const auto start = reader.table("start")) object.start = read_start(*start);
    for (TableReader& pin : reader.tables("pins")) object.pins.push_back(read_region(pin));
    for (TableReader& handle : reader.tables("handle")) object.handles.push_back(read_handle(handle));
    for (TableReader& load : reader.tables("load")) object.loads.push_back(read_load(load));
    if (reader.has("color")) {
        glm::dvec3 color{};
        reader.read("color", color, kFraction);
        object.color = color;
    }
    const auto copies = reader.table("copies");
    reader.finish();
    if (copies) return read_copies(*copies, object);
    return {object};
}

ColliderDescription read_collider(TableReader& reader, const CollisionSettings& collision) {
    ColliderDescription collider;
    collider.friction = collision.friction;
    collider.restitution = collision.restitution;
    reader.require({"shape"});
    TableReader shape = *reader.table("shape");
    const std::string kind = shape.require_one_of({"plane", "box", "sphere", "capsule"});
    if (kind == "plane") {
        PlaneCollider plane;
        shape.read_direction("plane", plane.normal);
        shape.read("offset", plane.offset);
        collider.shape = plane;
        for (const char* key : {"position", "rotation"}) {
            if (reader.has(key)) reader.fail(key, "a plane has none: its shape's normal and offset place it");
        }
    } else if (kind == "box") {
        BoxCollider box;
        shape.read("box", box.size, kPositive);
        collider.shape = box;
    } else if (kind == "sphere") {
        SphereCollider sphere;
        shape.read("sphere", sphere.radius, kPositive);
        collider.shape = sphere;
    } else {
        CapsuleCollider capsule;
        shape.read("capsule", capsule.radius, kPositive);
        shape.read("length", capsule.length, kPositive);
        collider.shape = capsule;
    }
    shape.finish();
    reader.read("position", collider.position);
    reader.read("rotation", collider.rotation);
    reader.read("friction", collider.friction, kNotNegative);
    reader.read("restitution", collider.restitution, kFraction);
    reader.finish();
    return collider;
}

}  // namespace

std::vector<ObjectDescription> read_objects(std::vector<TableReader> tables,
                                            const std::vector<Material>& materials,
                                            const std::filesystem::path& folder) {
    std::vector<ObjectDescription> objects;
    std::unordered_map<std::string, int> lines;  // by name
    for (TableReader& reader : tables) {
        for (ObjectDescription& object : read_object(reader, materials, folder)) {
            const auto [taken, is_new] = lines.emplace(object.name, object.line);
            if (!is_new) {
                const std::string what = reader.has("copies") ? fmt::format("\"{}\" ", object.name) : "";
                reader.fail("name", fmt::format("{}is taken by the object on line {}", what, taken->second));
            }
            objects.push_back(std::move(object));
        }
    }
    return objects;
}

std::vector<ColliderDescription> read_colliders(std::vector<TableReader> tables,
                                                const CollisionSettings& collision) {
    std::vector<ColliderDescription> colliders;
    for (TableReader& reader : tables) colliders.push_back(read_collider(reader, collision));
    return colliders;
}

}  // namespace gelatin
