#include "gpu/support/collision_scenarios.h"

#include <fmt/core.h>

#include <algorithm>

#include "model/setting_names.h"
#include "support/crowd.h"
#include "support/folded.h"
#include "support/parity.h"
#include "support/proximities.h"

namespace gelatin::test {
namespace {

constexpr double kStep = 1e-3;                     // [s]
constexpr double kLongStep = 0.1;                  // within it a block meets others [s]
constexpr int kCrowds[] = {7, 30, 2, 3, 90, 200};  // objects
constexpr BroadPhase kBroadPhases[] = {BroadPhase::hierarchy, BroadPhase::boxes, BroadPhase::none,
                                       BroadPhase::depth};

Model make_numbered_crowd(int objects) {
    return make_crowd(objects, static_cast<unsigned>(objects));
}

// Guards are untouched, and the fourth components as they were.
bool frames_are_kept(const Model& model, const NodeArrays& nodes) {
    bool kept = guard_is_untouched(nodes.positions, model.node_count()) &&
                guard_is_untouched(nodes.velocities, model.node_count());
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        kept = kept && nodes.positions[n].w == model.positions[n].w &&
               nodes.velocities[n].w == model.velocities[n].w;
    }
    return kept;
}

double response_error(const Model& model, const CollisionSettings& settings, double step) {
    const NodeArrays actual = respond_on_gpu(model, settings, step);
    if (!frames_are_kept(model, actual)) return error_if(true);
    return worst_response_error(model, settings, step, actual);
}

double self_response_error(Deformation deformation, const CollisionSettings& settings) {
    const Model model = make_folded(deformation);
    const NodeArrays actual = respond_to_self_on_gpu(model, settings, kStep);
    if (!frames_are_kept(model, actual)) return error_if(true);
    // In a plane normals are as they are rounded, and have no direction.
    const double bound = deformation == Deformation::flat ? 1e6 : 1.0;
    return worst_self_response_error(model, settings, kStep, actual) / bound;
}

double proximity_error(const Model& model, const CollisionSettings& settings) {
    const FoundOnGpu found = find_proximities_on_gpu(model, settings);
    const std::uint32_t node_face = found.starts[model.surface_parts.nodes.size()];
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& proximity : found.proximities) nearest = std::min(nearest, proximity.distance);
    return error_if(
        !found.is_guarded || found.lost_pairs + found.measure.lost > 0 ||
        found.measure.node_face != node_face || found.measure.edge_edge != found.starts.back() - node_face ||
        found.measure.nearest != nearest || !check_proximities<float>(model, settings, found).are_none());
}

}  // namespace

Scenarios collision_scenarios() {
    Scenarios scenarios;
    for (const int objects : kCrowds) {
        for (const BroadPhase broad_phase : kBroadPhases) {
            scenarios.push_back({fmt::format("{}_objects_by_{}", objects, name_of(broad_phase)), [=] {
                                     const Model model = make_numbered_crowd(objects);
                                     const auto expected = find_collisions_on_cpu<float>(
                                         model, {.broad_phase = BroadPhase::none});
                                     const auto actual =
                                         find_collisions_on_gpu(model, {.broad_phase = broad_phase});
                                     return error_if(expected.empty() || actual != expected);
                                 }});
        }
    }
    return scenarios;
}

Scenarios continuous_collision_scenarios() {
    Scenarios scenarios;
    for (const int objects : kCrowds) {
        for (const BroadPhase broad_phase : {BroadPhase::hierarchy, BroadPhase::boxes, BroadPhase::none}) {
            scenarios.push_back(
                {fmt::format("{}_objects_by_{}", objects, name_of(broad_phase)), [=] {
                     const Model model = make_numbered_crowd(objects);
                     const CollisionSettings settings{.broad_phase = broad_phase,
                                                      .detection = CollisionDetection::continuous};
                     const auto expected = find_collisions_on_cpu<double>(model, settings, kLongStep);
                     const std::size_t at_the_end = find_collisions_on_cpu<float>(model, {}).size();
                     return error_if(expected.size() <= at_the_end ||
                                     find_collisions_on_gpu(model, settings, kLongStep) != expected);
                 }});
        }
    }
    return scenarios;
}

Scenarios far_pair_scenarios() {
    Scenarios scenarios;
    for (const int extent : {4, 2, 8, 20, 1000}) {
        scenarios.push_back({fmt::format("over_{}_m", extent), [=] {
                                 const Model model = make_far_pairs(200, extent);
                                 const auto expected = find_collisions_on_cpu<float>(model, {});
                                 const auto actual =
                                     find_collisions_on_gpu(model, {.broad_phase = BroadPhase::depth});
                                 return error_if(expected.size() < 400 || actual != expected);
                             }});
    }
    return scenarios;
}

Scenarios response_scenarios() {
    Scenarios scenarios;
    for (const int objects : {7, 30, 2, 90}) {
        const auto add = [&](const char* name, const CollisionSettings& settings, double step) {
            scenarios.push_back({fmt::format("{}_objects_{}", objects, name), [=] {
                                     return response_error(make_numbered_crowd(objects), settings, step);
                                 }});
        };
        add("plain", {.friction = 0.0, .restitution = 0.0}, kStep);
        add("with_friction", {.friction = 0.4, .restitution = 0.7}, kStep);
        add("on_the_way", {.detection = CollisionDetection::continuous}, kLongStep);
        scenarios.push_back({fmt::format("{}_objects_with_handles", objects), [=] {
                                 Model model = make_numbered_crowd(objects);
                                 move_pinned(model, {1.0f, -2.0f, 0.5f});
                                 return response_error(model, {}, kStep);
                             }});
    }
    return scenarios;
}

Scenarios self_collision_scenarios() {
    Scenarios scenarios;
    for (const Deformation deformation : kDeformations) {
        for (const unsigned seed : {1u, 5u}) {
            scenarios.push_back({fmt::format("{}_{}", name_of(deformation), seed), [=] {
                                     const Model model = make_folded(deformation, seed);
                                     return error_if(find_self_contacts_on_gpu(model) !=
                                                     find_self_contacts_on_cpu<float>(model));
                                 }});
        }
        // Maps of a shape that was, and contacts of another, change nothing.
        for (const Deformation before : {Deformation::rigid, Deformation::poked, Deformation::rolled}) {
            scenarios.push_back({fmt::format("{}_after_{}", name_of(deformation), name_of(before)), [=] {
                                     const Model model = make_folded(deformation);
                                     return error_if(
                                         find_self_contacts_on_gpu_after(make_folded(before), model) !=
                                         find_self_contacts_on_cpu<float>(model));
                                 }});
        }
    }
    return scenarios;
}

Scenarios calm_scenarios() {
    Scenarios scenarios;
    for (const Deformation deformation : kDeformations) {
        scenarios.push_back({fmt::format("{}", name_of(deformation)), [=] {
                                 const Model model = make_folded(deformation);
                                 std::uint32_t restless = 0;
                                 std::size_t expected = 0;
                                 find_self_contacts_on_gpu(model, &restless);
                                 find_self_contacts_on_cpu<float>(model, &expected);
                                 // Rounding decides of few.
                                 return (double(restless) - double(expected)) /
                                        (0.1 * double(expected) + 3.0);
                             }});
    }
    // A map is good for as long as it explains where the nodes are: far away, too, and after a small turn.
    scenarios.push_back({"moved_as_one", [] {
                             const Model start = make_folded(Deformation::rigid);
                             Model moved = start;
                             for (glm::vec4& p : moved.positions)
                                 p += glm::vec4(20.0f - 1e-3f * p.y, 1e-3f * p.x, -7.0f, 0.0f);
                             std::uint32_t fitted = 1;
                             find_self_contacts_on_gpu_after(start, moved, &fitted);
                             return error_if(fitted != 0);
                         }});
    return scenarios;
}

Scenarios self_response_scenarios() {
    Scenarios scenarios;
    for (const Deformation deformation : kDeformations) {
        scenarios.push_back(
            {fmt::format("{}_with_friction", name_of(deformation)),
             [=] { return self_response_error(deformation, {.friction = 0.4, .restitution = 0.7}); }});
        scenarios.push_back(
            {fmt::format("{}_plain", name_of(deformation)),
             [=] { return self_response_error(deformation, {.friction = 0.0, .restitution = 0.0}); }});
    }
    return scenarios;
}

Scenarios proximity_scenarios() {
    Scenarios scenarios;
    for (const ProximityScene& scene : kProximityScenes) {
        for (const bool own : {true, false}) {
            const CollisionSettings settings{.self_collision = own, .proximity_radius = scene.radius};
            scenarios.push_back({fmt::format("{}_{}", scene.name, own ? "with_own" : "of_others"),
                                 [=] { return proximity_error(scene.make(), settings); }});
        }
    }
    return scenarios;
}

Scenarios mark_scenarios() {
    return {{"others",
             [] {
                 const Model model = make_crowd(30);
                 std::vector<std::uint32_t> expected(model.faces.size(), 0);
                 for (const auto& [face, other, touch] : find_collisions_on_cpu<float>(model, {}))
                     expected[face] = 1;
                 return error_if(mark_faces_on_gpu(model) != expected);
             }},
            {"own", [] {
                 const Model model = make_folded(Deformation::rolled);
                 std::vector<std::uint32_t> expected = find_self_contacts_by_brute_force(model);
                 for (std::uint32_t& mark : expected) mark = std::min(mark, 1u);
                 for (const auto& [face, other, touch] : find_collisions_by_brute_force(model))
                     expected[face] = 1;
                 return error_if(mark_faces_on_gpu(model, {.self_collision = true}) != expected);
             }}};
}

}  // namespace gelatin::test
