#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <tuple>

#include "core/file.h"
#include "core/log.h"
#include "gelatin/scene.h"
#include "model/scene/named_meshes.h"
#include "model/scene/override_scene.h"
#include "model/scene/parse_scene.h"
#include "model/scene/scene_file_bodies.h"
#include "model/scene/scene_file_drives.h"
#include "model/scene/scene_file_override.h"
#include "model/scene/scene_file_places.h"
#include "model/scene/scene_file_reader.h"
#include "model/scene/scene_writer.h"
#include "model/scene/validation.h"
#include "model/setting_names.h"

namespace gelatin {
namespace {

constexpr std::string_view kAutomatic = "auto";
toml::table parse(const std::string& text, const std::filesystem::path& file) {
    try {
        return toml::parse(text, file.string());
    } catch (const toml::parse_error& error) {
        const int line = static_cast<int>(error.source().begin.line);
        throw InvalidInput({file.string(), line, {}, {}, describe(error)});
    }
}

SimulationSettings read_simulation(TableReader reader) {
    SimulationSettings settings;
    reader.read("solver", settings.solver,
                {{"explicit_euler", SolverKind::explicit_euler},
                 {"semi_implicit_euler", SolverKind::semi_implicit_euler},
                 {"midpoint", SolverKind::midpoint},
                 {"rk4", SolverKind::rk4},
                 {"implicit", SolverKind::implicit},
                 {"vbd", SolverKind::implicit}});
    if (const toml::node* solver = reader.find("solver"); solver && solver->value_or(std::string()) == "vbd")
        log_note(fmt::format("{}:{}: simulation.solver = \"vbd\": this is \"implicit\" now",
                             *solver->source().path, solver->source().begin.line));
    reader.read("forces", settings.forces,
                {{"divide_and_merge", ForceMethod::divide_and_merge}, {"fused", ForceMethod::fused}});
    reader.read("frame_rate", settings.frame_rate);
    if (const toml::node* substeps = reader.find("substeps");
        substeps && substeps->value_or("") != kAutomatic) {
        int count = 0;
        if (!substeps->is_integer()) reader.fail("substeps", fmt::format("must be {}", kSubsteps.allowed));
        reader.read("substeps", count);
        settings.substeps = count;
    }
    reader.read("iterations", settings.iterations);
    if (reader.has("gravity")) reader.read("gravity", settings.gravity.emplace(0.0));
    reader.read("frames", settings.frames);
    reader.read("sleep", settings.sleep);
    reader.finish();
    return settings;
}

MaterialPair read_pair(TableReader& reader) {
    MaterialPair pair;
    reader.require({"materials"});
    std::tie(pair.first, pair.second) = reader.read_two_texts("materials");
    reader.read("friction", pair.friction);
    reader.read("contact_stiffness", pair.contact_stiffness);
    reader.read("restitution", pair.restitution);
    reader.finish();
    return pair;
}

CollisionSettings read_collision(TableReader reader) {
    CollisionSettings settings;
    reader.read("broad_phase", settings.broad_phase,
                {{"none", BroadPhase::none},
                 {"boxes", BroadPhase::boxes},
                 {"hierarchy", BroadPhase::hierarchy},
                 {"depth", BroadPhase::depth}});
    reader.read("detection", settings.detection,
                {{"discrete", CollisionDetection::discrete}, {"continuous", CollisionDetection::continuous}});
    reader.read("response", settings.response,
                {{"restore", CollisionResponse::restore}, {"contact", CollisionResponse::contact}});
    reader.read("self_collision", settings.self_collision);
    reader.read("proximity_radius", settings.proximity_radius);
    reader.read("friction", settings.friction);
    reader.read("restitution", settings.restitution);
    for (TableReader& pair : reader.tables("pair")) settings.pairs.push_back(read_pair(pair));
    reader.finish();
    return settings;
}

CameraDescription read_camera(TableReader reader) {
    CameraDescription camera{};
    reader.require({"eye", "target"});
    reader.read("eye", camera.eye);
    reader.read("target", camera.target);
    reader.read("field_of_view", camera.field_of_view);
    reader.finish();
    return camera;
}

std::optional<SpringKinds> read_springs(TableReader& reader) {
    if (!reader.has("springs")) return std::nullopt;
    const auto names = reader.read_names("springs", spring_kind_names());
    const auto has = [&](const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    return SpringKinds{has("structural"), has("shear"), has("flex")};
}

Material read_material(TableReader& reader) {
    Material material;
    reader.require({"name"});
    material.line = reader.line();
    reader.read("name", material.name);
    if (is_plain_name(material.name)) reader.set_path("material." + material.name);
    reader.read("model", material.model,
                {{"mass_spring", MaterialModel::mass_spring}, {"neo_hookean", MaterialModel::neo_hookean}});
    reader.read("youngs_modulus", material.youngs_modulus);
    reader.read("density", material.density);
    reader.read("poisson_ratio", material.poisson_ratio);
    reader.read("damping", material.damping);
    material.springs = read_springs(reader);
    reader.read("friction", material.friction);
    reader.read("thickness", material.thickness);
    reader.read("contact_stiffness", material.contact_stiffness);
    reader.read("restitution", material.restitution);
    reader.finish();
    return material;
}

std::vector<Material> read_materials(std::vector<TableReader> tables) {
    std::vector<Material> materials;
    for (TableReader& reader : tables) materials.push_back(read_material(reader));
    return materials;
}

/// @param file names the text in messages; paths are relative to its folder
Scene read_scene(const std::string& text, const std::filesystem::path& file,
                 const std::vector<std::string>& overrides) {
    toml::table document = parse(text, file);
    for (const std::string& change : overrides) apply_override(document, change);

    const std::string name = file.string();
    TableReader reader(document, "", name);
    Scene scene;
    scene.file = file;
    reader.read("up", scene.up, {{"y", Axis::y}, {"z", Axis::z}});
    const auto simulation = reader.table("simulation"), collision = reader.table("collision"),
               camera = reader.table("camera");
    auto materials = reader.tables("material"), objects = reader.tables("object"),
         rigids = reader.tables("rigid"), colliders = reader.tables("collider"),
         attachments = reader.tables("attachment");
    reader.finish();  // a misspelt section first: what it should have held is missing elsewhere

    if (simulation) scene.simulation = read_simulation(*simulation);
    if (collision) scene.collision = read_collision(*collision);
    if (camera) scene.camera = read_camera(*camera);
    scene.materials = read_materials(std::move(materials));
    ReadObjects read = merge_objects(read_objects(std::move(objects), scene.materials, file.parent_path()),
                                     read_rigids(std::move(rigids), scene.materials, file.parent_path()));
    scene.objects = std::move(read.objects);
    scene.colliders = read_colliders(std::move(colliders), scene.collision, file.parent_path());
    scene.attachments = read_attachments(std::move(attachments));
    const ScenePlaces places(document, scene, std::move(read.tables));
    validate(scene, [&](const FieldPath& field, const std::string& value, const std::string& problem) {
        places.report(field, value, problem);
    });
    return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return read_scene(read_file(file), file, overrides);
}

Scene parse_scene(const std::string& text, const std::filesystem::path& file) {
    return read_scene(text, file, {});
}

std::vector<AttachmentDescription> parse_attachments(const std::string& text) {
    toml::table document = parse(text, {});
    TableReader reader(document, "", {});
    auto attachments = reader.tables("attachment");
    reader.finish();
    return read_attachments(std::move(attachments));
}

Scene override_scene(const Scene& scene, const std::vector<std::string>& overrides) {
    if (overrides.empty()) {
        validate(scene);
        return scene;
    }
    const std::filesystem::path folder = scene.file.parent_path();
    Scene named = scene;
    const InMemory in_memory = name_meshes(named, folder);
    Scene result = read_scene(to_toml(named, folder), scene.file, overrides);
    restore_meshes(result, in_memory);
    result.meshes = scene.meshes;
    return result;
}

}  // namespace gelatin
