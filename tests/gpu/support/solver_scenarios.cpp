#include "gpu/support/solver_scenarios.h"

#include <fmt/core.h>

#include <algorithm>

#include "gpu/support/drive_on_gpu.h"
#include "gpu/support/measure_on_gpu.h"
#include "gpu/support/pull_on_gpu.h"
#include "gpu/support/skin_on_gpu.h"
#include "gpu/support/tet_values.h"
#include "gpu/support/watched_runs.h"
#include "model/drive/handle_animation.h"
#include "model/drive/handle_arms.h"
#include "model/setting_names.h"
#include "support/lost_shapes.h"
#include "support/mixed_bodies.h"
#include "support/parity.h"
#include "support/step_on_gpu.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

constexpr double kSolverStep = 2e-4;         // [s]
constexpr double kSolverFrame = 1.0 / 60.0;  // [s]
constexpr SolverKind kIntegrators[] = {SolverKind::semi_implicit_euler, SolverKind::rk4,
                                       SolverKind::explicit_euler, SolverKind::midpoint};
constexpr ForceMethod kForceMethods[] = {ForceMethod::fused, ForceMethod::divide_and_merge};

std::string name_of_step(SolverKind solver, ForceMethod forces) {
    return fmt::format("{}_{}", name_of(solver), forces == ForceMethod::fused ? "fused" : "divide_and_merge");
}

bool guards_are_untouched(const Model& model, const NodeArrays& nodes) {
    return guard_is_untouched(nodes.positions, model.node_count()) &&
           guard_is_untouched(nodes.velocities, model.node_count());
}

double step_error(const Model& model, SolverKind solver, ForceMethod forces) {
    const NodeArrays actual = step_on_gpu(model, solver, forces, kSolverStep);
    if (!guards_are_untouched(model, actual)) return error_if(true);
    return worst_error(model, rounding_bounds(model, solver, kSolverStep),
                       oracle_step(model, solver, kSolverStep), actual.positions, actual.velocities);
}

// Vertices of its own move the first handle's nodes.
Model with_animation(Model model) {
    Handle& handle = model.handles[0];
    auto animation = std::make_shared<HandleAnimation>();
    VertexFrames frames{{{}, {}, {}}, 2.0};
    std::uint32_t count = 0;
    for (HandleNode& held : model.handle_nodes) {
        if (held.handle != 0) continue;
        held.animated = count;
        animation->sources.push_back(count++);
        const glm::dvec3 arm(held.arm);
        frames.frames[0].push_back(arm);
        frames.frames[1].push_back(arm + glm::dvec3(0.1 * arm.y, 0.2, 0.3 * arm.x));
        frames.frames[2].push_back(1.5 * arm);
    }
    animation->motion.emplace().of = std::move(frames);
    handle.animation = std::move(animation);
    return model;
}

// No body is at rest.
Model make_stretched_bodies(double damping, double poisson_ratio, MaterialModel material) {
    Model model = make_mixed_bodies(damping, poisson_ratio, material);
    for (glm::vec4& p : model.positions) p.x *= 1.02f;
    return model;
}

// Its third body lies in one point.
Model make_fallen_in_tets() {
    Model model = make_mixed_bodies(0.0, 0.45, MaterialModel::neo_hookean);
    const Range& point = model.objects[2].nodes;
    for (std::uint32_t n = point.first; n < point.end(); ++n)
        model.positions[n] = glm::vec4(0.0f, 1.0f, 1.0f, model.positions[n].w);
    return model;
}

double energy_error(const Model& model) {
    return worst_energy_error(model, measure_on_gpu(model));
}

}  // namespace

Scenarios joined(const std::vector<Scenarios>& lists) {
    Scenarios all;
    for (const Scenarios& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

Scenarios step_scenarios() {
    Scenarios scenarios;
    for (const SolverKind solver : kIntegrators) {
        for (const ForceMethod forces : kForceMethods) {
            const std::string name = name_of_step(solver, forces);
            scenarios.push_back({name, [=] { return step_error(make_lively_model(), solver, forces); }});
            scenarios.push_back(
                {name + "_driven", [=] { return step_error(make_driven_model(), solver, forces); }});
        }
    }
    return scenarios;
}

Scenarios kinematics_scenarios() {
    Scenarios scenarios;
    for (const double time : {0.3, 1.1, 0.0, 0.49, 0.9, 5.0}) {
        scenarios.push_back(
            {fmt::format("at_{:.0f}_hundredths", 100.0 * time), [=] {
                 const Model model = with_animation(make_driven_model());
                 const auto motions = handle_motions(model.handles, time, kSolverFrame);
                 const std::vector<Drag> none(model.handles.size());
                 const HandleTimes times{{time, time}, {time + kSolverFrame, time + kSolverFrame}};
                 const auto animated = HandleArms(std::make_shared<const Model>(model))
                                           .motions(none, none, times, kSolverFrame);
                 const NodeArrays actual = apply_kinematics_on_gpu(model, motions, animated);
                 if (!guards_are_untouched(model, actual)) return error_if(true);
                 return worst_kinematics_error(model, motions, animated, actual);
             }});
    }
    return scenarios;
}

Scenarios load_scenarios() {
    Scenarios scenarios;
    const auto add = [&](const char* name, const std::vector<float>& factors) {
        scenarios.push_back({name, [=] {
                                 const Model model = make_driven_model();
                                 return worst_load_error(model, factors, sum_loads_on_gpu(model, factors));
                             }});
    };
    add("some", {0.3f, 0.0f, 0.7f, 1.0f});
    add("all", {1.0f, 1.0f, 1.0f, 1.0f});
    add("none", {0.0f, 0.0f, 0.0f, 0.0f});
    return scenarios;
}

Scenarios pull_scenarios() {
    Scenarios scenarios;
    for (const bool driven : {false, true}) {
        const std::string beside = driven ? "_beside_loads" : "";
        for (const SolverKind solver : kIntegrators) {
            for (const ForceMethod forces : kForceMethods) {
                scenarios.push_back({name_of_step(solver, forces) + beside, [=] {
                                         const Model model =
                                             driven ? make_driven_model() : make_lively_model();
                                         return worst_pull_error(model, solver, forces, kSolverStep);
                                     }});
            }
        }
    }
    return scenarios;
}

Scenarios matching_scenarios() {
    return {{"usual", [] { return worst_matching_error(1.0); }},
            {"tiny", [] { return worst_matching_error(1e-3); }},
            {"huge", [] { return worst_matching_error(1e2); }}};
}

Scenarios neo_hookean_step_scenarios() {
    Scenarios scenarios;
    for (const SolverKind solver : {SolverKind::semi_implicit_euler, SolverKind::rk4}) {
        for (const double damping : {0.0, 2e-3}) {
            for (const ForceMethod forces : kForceMethods) {
                scenarios.push_back({name_of_step(solver, forces) + (damping > 0.0 ? "_damped" : ""),
                                     [=] { return step_error(make_lively_tets(damping), solver, forces); }});
            }
        }
    }
    scenarios.push_back({"point", [] {
                             return step_error(make_fallen_in_tets(), SolverKind::semi_implicit_euler,
                                               ForceMethod::fused);
                         }});
    return scenarios;
}

Scenarios neo_hookean_energy_scenarios() {
    return {{"lively", [] { return energy_error(make_lively_tets(0.0)); }},
            {"at_rest", [] {
                 Material material;
                 material.model = MaterialModel::neo_hookean;
                 return energy_error(make_model(make_body(make_block({5, 5, 5}, {1, 1, 1}, 0.2), material)));
             }}};
}

Scenarios volume_step_scenarios() {
    Scenarios scenarios;
    for (const SolverKind solver : {SolverKind::semi_implicit_euler, SolverKind::rk4}) {
        for (const ForceMethod forces : kForceMethods) {
            for (const MaterialModel most : {MaterialModel::mass_spring, MaterialModel::neo_hookean}) {
                for (const double poisson_ratio : {0.0, 0.45}) {
                    scenarios.push_back(
                        {fmt::format("{}{}_poisson_ratio_{:.0f}_hundredths", name_of_step(solver, forces),
                                     most == MaterialModel::neo_hookean ? "_beside_tets" : "",
                                     100.0 * poisson_ratio),
                         [=] {
                             return step_error(make_stretched_bodies(2e-3, poisson_ratio, most), solver,
                                               forces);
                         }});
                }
            }
        }
    }
    return scenarios;
}

// With tets inside out, where what the term gives below 1/4 has ended.
Scenarios volume_energy_scenarios() {
    Scenarios scenarios;
    for (const double poisson_ratio : {0.0, 0.45}) {
        scenarios.push_back({fmt::format("poisson_ratio_{:.0f}_hundredths", 100.0 * poisson_ratio), [=] {
                                 return energy_error(
                                     make_stretched_bodies(0.0, poisson_ratio, MaterialModel::mass_spring));
                             }});
    }
    return scenarios;
}

Scenarios watch_scenarios() {
    return {{"runs", [] {
                 const Model model = make_lively_model();
                 const std::vector<WatchedRun> runs = watched_runs(model);
                 return error_if(std::any_of(runs.begin(), runs.end(), [&](const WatchedRun& run) {
                     return !agree(watch_on_gpu(model, run), watch_on_cpu(model, run));
                 }));
             }}};
}

Scenarios tet_value_scenarios() {
    Scenarios scenarios;
    const auto add = [&](const char* name, Quantity quantity) {
        scenarios.push_back({name, [=] {
                                 const Deformed bodies = make_deformed();
                                 return worst_value_error(bodies, quantity, values_on_gpu(bodies, quantity));
                             }});
    };
    add("stretch", Quantity::stretch);
    add("stress", Quantity::stress);
    add("speed", Quantity::speed);
    return scenarios;
}

Scenarios carry_skin_scenarios() {
    return {{"at_the_origin", [] { return carry_skin_error(0.0); }},
            {"far_from_the_origin", [] { return carry_skin_error(1000.0); }}};
}

}  // namespace gelatin::test
