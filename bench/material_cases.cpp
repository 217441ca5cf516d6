#include "bench/material_cases.h"

#include <tbb/info.h>

#include "bench/bodies.h"
#include "bench/threads.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "model/explicit/stability.h"
#include "model/springs/spring_cache.h"

namespace gelatin {
namespace {

constexpr double kRadius = 0.5;  // [m]
constexpr float kCompression = 0.95f;
constexpr double kFrame = 1.0 / 60.0;  // [s], an implicit step
constexpr double kDamping = 1e-3;      // [s]

struct MaterialKind {
    const char* name;
    MaterialModel model;
    double poisson_ratio, damping;
};
constexpr MaterialKind kKinds[] = {
    {"springs, nu 0.25", MaterialModel::mass_spring, 0.25, 0.0},
    {"springs, nu 0.3", MaterialModel::mass_spring, 0.3, 0.0},
    {"springs, nu 0.45", MaterialModel::mass_spring, 0.45, 0.0},
    {"neo-Hookean, nu 0.25", MaterialModel::neo_hookean, 0.25, 0.0},
    {"neo-Hookean, nu 0.3", MaterialModel::neo_hookean, 0.3, 0.0},
    {"neo-Hookean, nu 0.25, damped", MaterialModel::neo_hookean, 0.25, kDamping},
};

}  // namespace

// The balls' centres are at y = 0.
State MaterialCase::start() const {
    State state{model->positions, model->velocities, {}};
    for (glm::vec4& position : state.positions) position.y *= kCompression;
    return state;
}

StepSettings MaterialCase::settings(SolverKind solver) const {
    return {solver, solver == SolverKind::implicit ? kFrame : 0.5 * largest_stable_step(solver, *model)};
}

std::vector<MaterialCase> material_cases(int frequency) {
    Body ball;
    ball.mesh = tetrahedralise(make_sphere({kRadius, frequency}), MesherSettings{}, "ball");
    ball.fitted = std::make_shared<const FittedSprings>(SpringCache().fit(ball.mesh));
    std::vector<MaterialCase> cases;
    for (const MaterialKind& kind : kKinds) {
        ball.material.model = kind.model;
        ball.material.youngs_modulus = 1e5;
        ball.material.poisson_ratio = kind.poisson_ratio;
        ball.material.damping = kind.damping;
        cases.push_back({kind.name, make_copies(ball, {{-1.5, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.5, 0.0, 0.0}})});
    }
    return cases;
}

std::vector<StageSystem> material_systems(bool use_gl) {
    std::vector<StageSystem> systems = stage_systems(use_gl);
    if (tbb::info::default_concurrency() > 2)
        systems.insert(systems.begin() + 1, {describe_cpu(2), false, 2});
    return systems;
}

}  // namespace gelatin
