#include "bench/scaling_cases.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bench/bodies.h"
#include "bench/scene_file.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "model/assembly/build_model.h"
#include "sim/report.h"

namespace gelatin {
namespace {

using MakeModel = std::function<std::shared_ptr<const Model>()>;

constexpr double kRadius = 0.5;  // [m]
constexpr int kFrequency = 20;   // of the paper's Sphere 1: 8,000 faces
constexpr int kBallFrequency = 2;

// Distance between the centres of two balls, in radii.
constexpr double kTouching = 1.99, kDeep = 1.0, kApart = 2.5;

// Spacing of a lattice in which an inner ball touches about half of its six neighbours, in radii.
constexpr double kSpacing = 1.97, kJitter = 0.04;

TetMesh make_ball(int frequency) {
    return tetrahedralise(make_sphere({kRadius, frequency}), MesherSettings{}, "sphere");
}

std::vector<glm::dvec3> two_places(double distance) {
    return {glm::dvec3(0.0), glm::dvec3(distance * kRadius, 0.0, 0.0)};
}

CollisionSettings by(BroadPhase broad_phase) {
    return {.broad_phase = broad_phase};
}

void add_two_bodies(std::vector<ScalingCase>& cases) {
    const auto add = [&](const char* scene, double distance) {
        const auto make = [distance] { return make_copies(make_ball(kFrequency), two_places(distance)); };
        cases.push_back({ScalingPart::two_bodies,
                         scene,
                         make,
                         {by(BroadPhase::hierarchy), by(BroadPhase::boxes)},
                         query_stages()});
    };
    add("touching", kTouching);
    add("deep", kDeep);
}

void add_faces(const std::vector<int>& faces, std::vector<ScalingCase>& cases) {
    for (const int count : faces) {
        const int frequency = std::max(1, static_cast<int>(std::lround(std::sqrt(count / 40.0))));
        const auto make = [frequency] {
            return make_copies(make_hollow_ball(kRadius, frequency), two_places(kTouching));
        };
        cases.push_back({ScalingPart::faces,
                         fmt::format("{} faces", 40 * frequency * frequency),
                         make,
                         {by(BroadPhase::hierarchy)},
                         query_stages()});
    }
}

void add_objects(const std::vector<int>& objects, std::vector<ScalingCase>& cases) {
    const auto add = [&](const char* scene, double spacing, double jitter) {
        for (const int count : objects) {
            const auto make = [=] {
                return make_copies(
                    make_ball(kBallFrequency),
                    jittered_lattice(static_cast<std::size_t>(count), spacing * kRadius, jitter * kRadius));
            };
            cases.push_back({ScalingPart::objects,
                             fmt::format("{} {}", count, scene),
                             make,
                             {by(BroadPhase::hierarchy)},
                             step_stages()});
        }
    };
    add("touching", kSpacing, kJitter);
    add("apart", kApart, kJitter);
}

void add_self_collision(const std::filesystem::path& scenes, std::vector<ScalingCase>& cases) {
    for (const char* name : {"free_fall", "rain"}) {
        const auto make = [scenes, name] {
            const Scene scene = load_scene(find_bench_scene(scenes, std::string(name) + ".toml"),
                                           {"simulation.solver=semi_implicit_euler",
                                            "collision.response=restore", "collision.self_collision=true"});
            return std::make_shared<const Model>(build_model(scene));
        };
        CollisionSettings settings;
        settings.self_collision = true;
        cases.push_back({ScalingPart::self_collision, name, make, {settings}, self_stages()});
    }
}

}  // namespace

const char* name_of(ScalingPart part) {
    switch (part) {
        case ScalingPart::two_bodies:
            return "two bodies";
        case ScalingPart::faces:
            return "faces";
        case ScalingPart::objects:
            return "objects";
        case ScalingPart::self_collision:
            return "self-collision";
    }
    return "";
}

std::vector<ScalingCase> scaling_cases(const ScalingBenchOptions& options) {
    std::vector<ScalingCase> cases;
    add_two_bodies(cases);
    add_faces(options.faces, cases);
    add_objects(options.objects, cases);
    add_self_collision(options.scenes, cases);
    return cases;
}

std::string scaling_label(const ScalingCase& scaling_case, const CollisionSettings& method,
                          const StageSystem& system) {
    return fmt::format("{}, {}, {}, {}", name_of(scaling_case.part), scaling_case.scene,
                       name_of(method.broad_phase), system.name);
}

}  // namespace gelatin
