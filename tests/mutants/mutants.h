#pragma once

#include "gelatin/scene.h"

namespace gelatin::test {

/// A way to break a shader: `from` in `file` (below shaders/) becomes `to`.
struct Mutant {
    const char* name;
    const char* file;
    const char* from;
    const char* to;
    SolverKind solver;
    ForceMethod forces;
};

inline constexpr SolverKind kSemiImplicit = SolverKind::semi_implicit_euler;
inline constexpr ForceMethod kFused = ForceMethod::fused;
inline constexpr ForceMethod kDivided = ForceMethod::divide_and_merge;

inline constexpr Mutant kMutants[] = {
    {"second_spring_of_a_pair_is_left_out", "sim/advance_nodes.comp", "stiffness.y", "0.0", kSemiImplicit,
     kFused},
    {"lane_of_a_slice_is_shifted", "sim/advance_nodes.comp", "+ n % 64u", "+ (n + 1u) % 64u", kSemiImplicit,
     kFused},
    {"last_pair_is_left_out", "sim/advance_nodes.comp", "p < end", "p + 64u < end", kSemiImplicit, kFused},
    {"no_guard_at_the_end", "sim/advance_nodes.comp", "if (n >= node_count) return;", "", kSemiImplicit,
     kFused},
    {"damping_has_the_wrong_sign", "include/spring_force.glsl", "+ damping_time", "- damping_time",
     kSemiImplicit, kFused},
    {"rest_length_is_forgotten", "include/spring_force.glsl", "inverse_length - rest_length",
     "inverse_length", kSemiImplicit, kFused},
    {"damping_of_one_end_alone", "include/spring_force.glsl", "0.5 * (velocity_a.w + velocity_b.w)",
     "0.5 * velocity_a.w", kSemiImplicit, kFused},
    {"pins_are_ignored", "include/integrate_node.glsl", "base_position.w == 0.0", "false", kSemiImplicit,
     kFused},
    {"positions_move_with_the_old_velocity", "include/integrate_node.glsl", "semi_implicit != 0u", "false",
     kSemiImplicit, kFused},
    {"gravity_is_forgotten", "include/integrate_node.glsl", "gravity + ", "", kSemiImplicit, kFused},
    {"sums_start_over", "include/integrate_node.glsl", "is_first == 0u", "false", SolverKind::rk4, kFused},
    {"stages_ignore_their_weight", "include/integrate_node.glsl", "rate *= weight;", "", SolverKind::rk4,
     kFused},
    {"colliders_do_nothing", "include/colliders.glsl", "surface.w >= 0.0", "true", kSemiImplicit, kFused},
    {"friction_is_forgotten", "include/colliders.glsl",
     "float kept = speed > slowing ? 1.0 - slowing / speed : 0.0;", "float kept = 1.0;", kSemiImplicit,
     kFused},
    {"second_ends_are_pulled_the_wrong_way", "sim/merge_spring_forces.comp", "-on_first", "on_first",
     kSemiImplicit, kDivided},
    {"first_spring_is_skipped", "sim/merge_spring_forces.comp", "uint e = starts[n]",
     "uint e = starts[n] + 1u", kSemiImplicit, kDivided},
    {"the_last_springs_are_not_written", "sim/write_spring_forces.comp", "s >= spring_count",
     "s + 64u >= spring_count", kSemiImplicit, kDivided},
};

}  // namespace gelatin::test
