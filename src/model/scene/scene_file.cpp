#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>

#include "core/file.h"
#include "gelatin/scene.h"
#include "model/scene/scene_file_bodies.h"
#include "model/scene/scene_file_override.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {
namespace {

constexpr std::string_view kAutomatic = "auto";
constexpr Limit kSubsteps{"\"auto\" or from 1 to 1000000", [](double v) { return v >= 1.0 && v <= 1e6; }};
constexpr Limit kIterations{"from 1 to 1000", [](double v) { return v >= 1.0 && v <= 1e3; }};
constexpr Limit kPoissonRatio{"from 0 to 0.49", [](double v) { return v >= 0.0 && v <= 0.49; }};
constexpr Limit kNeoHookeanPoissonRatio{"0 or more and less than 0.5 with model = \"neo_hookean\"",
                                        [](double v) { return v >= 0.0 && v < 0.5; }};
constexpr Limit kSpectralRadius{"from 0 to less than 1", [](double v) { return v >= 0.0 && v < 1.0; }};
constexpr Limit kFieldOfView{"greater than 0 and less than 180",
                             [](double v) { return v > 0.0 && v < 180.0; }};

toml::table parse(const std::filesystem::path& file) {
    try {
        return toml::parse(read_file(file), file.string());
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
                 {"vbd", SolverKind::vbd}});
    reader.read("forces", settings.forces,
                {{"divide_and_merge", ForceMethod::divide_and_merge}, {"fused", ForceMethod::fused}});
    reader.read("frame_rate", settings.frame_rate, kPositive);
    if (const toml::node* substeps = reader.find("substeps");
        substeps && substeps->value_or("") != kAutomatic) {
        int count = 0;
        if (!substeps->is_integer()) reader.fail("substeps", fmt::format("must be {}", kSubsteps.allowed));
        reader.read("substeps", count, kSubsteps);
        settings.substeps = count;
    }
    reader.read("iterations", settings.iterations, kIterations);
    reader.read("chebyshev", settings.chebyshev, kSpectralRadius);
    reader.read("gravity", settings.gravity);
    reader.read("frames", settings.frames, kNotNegative);
    reader.finish();
    return settings;
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
    if (settings.broad_phase == BroadPhase::depth && settings.detection == CollisionDetection::continuous)
        reader.fail("detection", "must be \"discrete\" with broad_phase = \"depth\", which sees one moment");
    reader.read("response", settings.response, {{"restore", CollisionResponse::restore}});
    reader.read("self_collision", settings.self_collision);
    reader.read("proximity_radius", settings.proximity_radius, kPositive);
    if (settings.proximity_radius && settings.broad_phase == BroadPhase::depth) {
        reader.fail(
            "proximity_radius",
            "must not be given with broad_phase = \"depth\", which tells what touches, not what is near");
    }
    reader.read("friction", settings.friction, kNotNegative);
    reader.read("restitution", settings.restitution, kFraction);
    reader.finish();
    return settings;
}

CameraDescription read_camera(TableReader reader) {
    CameraDescription camera{};
    reader.require({"eye", "target"});
    reader.read("eye", camera.eye);
    reader.read("target", camera.target);
    reader.read("field_of_view", camera.field_of_view, kFieldOfView);
    if (camera.eye == camera.target) reader.fail("eye", "must not be the target");
    reader.finish();
    return camera;
}

std::optional<SpringKinds> read_springs(TableReader& reader) {
    if (!reader.has("springs")) return std::nullopt;
    const auto names = reader.read_names("springs", {"structural", "shear", "flex"});
    const auto has = [&](const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    return SpringKinds{has("structural"), has("shear"), has("flex")};
}

Material read_material(TableReader& reader) {
    Material material;
    reader.require({"name"});
    reader.read("name", material.name);
    reader.set_path("material." + material.name);
    reader.read("model", material.model,
                {{"mass_spring", MaterialModel::mass_spring}, {"neo_hookean", MaterialModel::neo_hookean}});
    const bool has_springs = material.model == MaterialModel::mass_spring;
    reader.read("youngs_modulus", material.youngs_modulus, kPositive);
    reader.read("density", material.density, kPositive);
    reader.read("poisson_ratio", material.poisson_ratio,
                has_springs ? kPoissonRatio : kNeoHookeanPoissonRatio);
    reader.read("damping", material.damping, kNotNegative);
    if (!has_springs && reader.has("springs"))
        reader.fail("springs", "must not be given with model = \"neo_hookean\", which has none");
    material.springs = read_springs(reader);
    reader.finish();
    return material;
}

std::vector<Material> read_materials(std::vector<TableReader> tables) {
    std::vector<Material> materials;
    std::vector<int> lines;
    for (TableReader& reader : tables) {
        Material material = read_material(reader);
        for (std::size_t i = 0; i < materials.size(); ++i) {
            if (materials[i].name != material.name) continue;
            reader.fail("name", fmt::format("is taken by the material on line {}", lines[i]));
        }
        materials.push_back(std::move(material));
        lines.push_back(reader.line());
    }
    return materials;
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    toml::table document = parse(file);
    for (const std::string& text : overrides) apply_override(document, text);

    const std::string name = file.string();
    TableReader reader(document, "", name);
    Scene scene;
    scene.file = file;
    const auto simulation = reader.table("simulation"), collision = reader.table("collision"),
               camera = reader.table("camera");
    auto materials = reader.tables("material"), objects = reader.tables("object"),
         colliders = reader.tables("collider");
    reader.finish();  // a misspelt section first: what it should have held is missing elsewhere

    if (simulation) scene.simulation = read_simulation(*simulation);
    if (collision) scene.collision = read_collision(*collision);
    if (camera) scene.camera = read_camera(*camera);
    scene.materials = read_materials(std::move(materials));
    scene.objects = read_objects(std::move(objects), scene.materials, file.parent_path());
    scene.colliders = read_colliders(std::move(colliders), scene.collision);
    if (scene.objects.empty()) throw InvalidInput({name, 0, {}, {}, "has no objects: add an [[object]]"});
    return scene;
}

}  // namespace gelatin
