#include "model/scene/validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "gelatin/error.h"
#include "model/scene/names.h"
#include "model/scene/validate_attachments.h"
#include "model/scene/validate_bodies.h"
#include "model/setting_names.h"

namespace gelatin {
namespace {

constexpr Limit kIterations{"from 1 to 1000", [](double v) { return v >= 1.0 && v <= 1e3; }};
constexpr Limit kPoissonRatio{"from 0 to 0.49", [](double v) { return v >= 0.0 && v <= 0.49; }};
constexpr Limit kNeoHookeanPoissonRatio{"0 or more and less than 0.5 with model = \"neo_hookean\"",
                                        [](double v) { return v >= 0.0 && v < 0.5; }};
constexpr Limit kFieldOfView{"greater than 0 and less than 180",
                             [](double v) { return v > 0.0 && v < 180.0; }};

void check_simulation(const ValueChecks& checks, const SimulationSettings& settings) {
    const FieldPath field("simulation");
    checks.check(field / "frame_rate", settings.frame_rate, kPositive);
    checks.check(field / "substeps", settings.substeps, kSubsteps);
    checks.check(field / "iterations", settings.iterations, kIterations);
    checks.check(field / "gravity", settings.gravity);
    checks.check(field / "frames", settings.frames, kNotNegative);
}

void check_collision(const ValueChecks& checks, const CollisionSettings& settings, SolverKind solver) {
    const FieldPath field("collision");
    const bool sees_one_moment = settings.broad_phase == BroadPhase::depth;
    if (sees_one_moment && settings.detection == CollisionDetection::continuous) {
        checks.fail(field / "detection", text_of(name_of(settings.detection)),
                    "must be \"discrete\" with broad_phase = \"depth\", which sees one moment");
    }
    checks.check(field / "proximity_radius", settings.proximity_radius, kPositive);
    if (settings.proximity_radius && sees_one_moment) {
        checks.fail(
            field / "proximity_radius", text_of(*settings.proximity_radius),
            "must not be given with broad_phase = \"depth\", which finds what touches, not what is near");
    }
    if (settings.response_with(solver) == CollisionResponse::contact) {
        if (!is_implicit(solver)) {
            checks.fail(field / "response", text_of(name_of(CollisionResponse::contact)),
                        "needs solver = \"implicit\"; with other solvers it must be \"restore\"");
        }
        if (sees_one_moment) {
            checks.fail(field / "broad_phase", text_of(name_of(settings.broad_phase)),
                        "must be none, boxes or hierarchy with response = \"contact\", which is what "
                        "implicit solvers have unless response = \"restore\" is given");
        }
    }
    checks.check(field / "friction", settings.friction, kNotNegative);
    checks.check(field / "restitution", settings.restitution, kFraction);
}

void check_camera(const ValueChecks& checks, const CameraDescription& camera) {
    const FieldPath field("camera");
    checks.check(field / "eye", camera.eye);
    checks.check(field / "target", camera.target);
    checks.check(field / "field_of_view", camera.field_of_view, kFieldOfView);
    if (glm::vec3(camera.eye) == glm::vec3(camera.target))  // as they are drawn
        checks.fail(field / "eye", text_of(camera.eye), "must not be the target");
}

void check_material(const ValueChecks& checks, const FieldPath& field, const Material& material) {
    const bool has_springs = material.model == MaterialModel::mass_spring;
    checks.check_text(field / "name", material.name);
    checks.check(field / "youngs_modulus", material.youngs_modulus, kPositive);
    checks.check(field / "density", material.density, kPositive);
    checks.check(field / "poisson_ratio", material.poisson_ratio,
                 has_springs ? kPoissonRatio : kNeoHookeanPoissonRatio);
    checks.check(field / "damping", material.damping, kNotNegative);
    if (!material.springs) return;
    const std::vector<std::string> kinds = kind_names(*material.springs);
    const std::string value = kinds.empty() ? "[]" : fmt::format("[\"{}\"]", fmt::join(kinds, "\", \""));
    if (!has_springs) {
        checks.fail(field / "springs", value,
                    "must not be given with model = \"neo_hookean\", which has none");
    }
    if (kinds.empty())
        checks.fail(field / "springs", value,
                    fmt::format("must name at least one of {}", join_names(spring_kind_names(), "or")));
}

// What only contact knows.
void check_surface(const ValueChecks& checks, const FieldPath& field, const Material& material,
                   bool has_contact) {
    checks.check(field / "friction", material.friction, kNotNegative);
    checks.check(field / "thickness", material.thickness, kPositive);
    checks.check(field / "contact_stiffness", material.contact_stiffness, kPositive);
    checks.check(field / "restitution", material.restitution, kFraction);
    if (has_contact) return;
    const std::string needs = "needs collision.response = \"contact\"";
    if (material.friction) checks.fail(field / "friction", text_of(*material.friction), needs);
    if (material.thickness) checks.fail(field / "thickness", text_of(*material.thickness), needs);
    if (material.contact_stiffness != 1.0)
        checks.fail(field / "contact_stiffness", text_of(material.contact_stiffness), needs);
    if (material.restitution) checks.fail(field / "restitution", text_of(*material.restitution), needs);
}

void check_pairs(const ValueChecks& checks, const Scene& scene) {
    const std::vector<MaterialPair>& pairs = scene.collision.pairs;
    std::vector<std::string> names;
    for (const Material& material : scene.materials) names.push_back(material.name);
    std::set<std::pair<std::string, std::string>> known;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const FieldPath field = (FieldPath("collision") / "pair")[p];
        const std::string both = fmt::format("[{}, {}]", text_of(pairs[p].first), text_of(pairs[p].second));
        for (const std::string& name : {pairs[p].first, pairs[p].second}) {
            if (std::find(names.begin(), names.end(), name) == names.end())
                checks.fail(field / "materials", both,
                            names.empty() ? "there are no materials"
                                          : fmt::format("must be of {}", join_names(names, "or")));
        }
        if (!known.insert(std::minmax(pairs[p].first, pairs[p].second)).second)
            checks.fail(field / "materials", both, "is there twice");
        checks.check(field / "friction", pairs[p].friction, kNotNegative);
        checks.check(field / "contact_stiffness", pairs[p].contact_stiffness, kPositive);
        checks.check(field / "restitution", pairs[p].restitution, kFraction);
        if (!scene.has_contact()) checks.fail(field, both, "needs collision.response = \"contact\"");
    }
}

void check_materials(const ValueChecks& checks, const std::vector<Material>& materials, bool has_contact) {
    for (std::size_t m = 0; m < materials.size(); ++m) {
        const FieldPath field("material", m);
        check_material(checks, field, materials[m]);
        check_surface(checks, field, materials[m], has_contact);
        for (std::size_t i = 0; i < m; ++i) {
            if (materials[i].name != materials[m].name) continue;
            checks.fail(field / "name", text_of(materials[m].name),
                        name_taken("material", materials[i].line));
        }
    }
}

}  // namespace

void validate(const Scene& scene, const ReportProblem& report) {
    const ValueChecks checks(report);
    if (scene.up == Axis::x)
        checks.fail(FieldPath("up"), text_of(name_of(scene.up)), "must be \"y\" or \"z\"");
    check_simulation(checks, scene.simulation);
    check_collision(checks, scene.collision, scene.simulation.solver);
    if (scene.camera) check_camera(checks, *scene.camera);
    check_materials(checks, scene.materials, scene.has_contact());
    check_pairs(checks, scene);
    check_objects(checks, scene);
    check_colliders(checks, scene);
    check_attachments(checks, scene);
}

void check_camera(const CameraDescription& camera) {
    const ReportProblem report = [](const FieldPath& field, const std::string& value,
                                    const std::string& problem) {
        throw InvalidInput({{}, 0, describe(field, {}), value, problem});
    };
    check_camera(ValueChecks(report), camera);
}

std::string name_at(const Scene& scene, const FieldPath& path) {
    if (path.steps().empty() || !path.steps().front().index) return {};
    const std::size_t index = *path.steps().front().index;
    const std::string_view list = path.steps().front().key;
    if (list == "material") return scene.materials[index].name;
    if (list == "attachment") return scene.attachments[index].name;
    if (list == "collider") return scene.colliders[index].name;
    return list == "object" || list == "rigid" ? scene.objects[index].name : std::string();
}

void validate(const Scene& scene) {
    validate(scene, [&](const FieldPath& field, const std::string& value, const std::string& problem) {
        throw InvalidInput({scene.file.string(), 0, describe(field, name_at(scene, field)), value, problem});
    });
}

}  // namespace gelatin
