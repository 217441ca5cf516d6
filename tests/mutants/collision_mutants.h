#pragma once

#include "gpu/support/mutants.h"

namespace gelatin::test {

/// Of detection.
inline constexpr Mutant kCollisionMutants[] = {
    {"the_last_nodes_of_a_level_have_no_box", "sim/collision/update_boxes.comp", "index >= node_count",
     "index + 1u >= node_count"},
    {"a_box_forgets_a_corner", "sim/collision/update_boxes.comp", "max(a, max(b, c))", "max(a, b)"},
    {"a_walk_skips_too_far", "sim/collision/walk_trees.comp", "near ? n + 1u : node.x", "node.x"},
    {"boxes_meet_along_two_axes", "sim/collision/bounds.glsl", "all(lessThanEqual(min_b, max_a))",
     "min_b.x <= max_a.x"},
    {"a_pair_is_seen_from_one_side", "sim/collision/object_may_touch.glsl", "a != b", "a < b"},
    {"rows_overlap", "sim/collision/scan_pair_rows.comp", "PairRow(at.x,", "PairRow(max(at.x, 1u) - 1u,"},
    {"entries_of_the_last_object_are_left_out", "sim/collision/scan_pair_rows.comp",
     "dispatch_invocations(kept_entries)", "dispatch_invocations(kept_entries - 40u)"},
    {"bits_are_not_cleared", "sim/collision/list_candidates.comp", "if (leaf % 4u == 0u)", "if (false)"},
    {"candidates_reach_the_lower_corner", "sim/collision/list_candidates.comp",
     "other.min.xyz, other.max.xyz", "other.min.xyz, other.min.xyz"},
    {"tests_of_the_first_pair_again", "sim/collision/scan_tests.comp", "object_pairs[p].first_test = at;",
     "object_pairs[p].first_test = 0u;"},
    {"the_last_block_is_left_out", "sim/collision/face_tests.glsl",
     "bounding_boxes[pair.other].face_count + size - 1u) / size",
     "max(bounding_boxes[pair.other].face_count / size, 1u) - 1u)"},
    {"leaves_forget_an_object", "sim/collision/object_may_touch.glsl", "near ? node.z : 0u",
     "near ? max(node.z, 1u) - 1u : 0u"},
    {"rows_are_not_sorted", "sim/collision/list_object_pairs.comp", "object_pairs[place - 1u].other > other",
     "false"},
    {"a_leaf_has_three_faces", "sim/collision/walk_trees.comp", "k < 4u", "k < 3u"},
    {"the_larger_object_starts", "sim/collision/pairs.glsl", "ours == theirs && pair.object < pair.other",
     "false"},
    {"half_a_word_of_tests", "sim/collision/cull_face_pairs.comp", "k < 32u", "k < 16u"},
    {"culled_faces_are_tested", "sim/collision/list_candidates.comp", "!face_may_collide",
     "face_may_collide"},
    {"too_few_groups_of_face_pairs", "sim/collision/dispatches.glsl", "slot % 64u == 0u",
     "slot % 128u == 0u"},
    {"one_side_alone_collides", "sim/collision/test_face_pairs.comp",
     "set_touch(find_pair(b.object, a.object), face_pair.other_face, touches.y);", ""},
    {"faces_with_boxes_that_meet_collide", "sim/collision/test_face_pairs.comp", "if (touches.x == 0u)",
     "touches.x |= kTouches; if (false)"},
};

/// Of continuous detection.
inline constexpr Mutant kContinuousMutants[] = {
    {"boxes_hold_the_end_alone", "sim/collision/update_boxes.comp",
     "box = join(box, box_of_corners(faces[f], previous_positions));", ""},
    {"one_face_stands_still", "sim/collision/test_face_pairs.comp", "corners(b, previous_positions)",
     "corners(b, positions)"},
    {"what_moves_away_enters", "sim/collision/face_contact.glsl", "dot(relative, normal) > 0.0",
     "dot(relative, normal) != 0.0"},
    {"sides_enter", "sim/collision/face_contact.glsl", "< kAcross", "< 0.0"},
    {"planes_lie_anywhere", "sim/collision/time_of_impact.glsl", "ends_apart), vec3(0.0), starts_apart)",
     "ends_apart), vec3(0.0), not(starts_apart))"},
};

/// Of broad_phase = "depth".
inline constexpr Mutant kDepthMutants[] = {
    {"pixels_count_by_their_centers", "sim/depth/face_footprint.geom", "0.5 + 0.0078", "0.0"},
    {"depth_is_that_of_the_center", "sim/depth/face_footprint.geom", "kReach * (abs(slope.x) + abs(slope.y))",
     "0.0"},
    {"edges_look_outwards", "sim/depth/face_footprint.geom", "< 0.0) normal = -normal",
     "> 0.0) normal = -normal"},
    {"a_face_is_as_deep_as_its_nearest_point", "sim/depth/find_hidden_faces.frag", "greatest_depth() <",
     "least_depth() <"},
    {"hidden_by_the_nearest_alone", "sim/depth/find_hidden_faces.frag",
     "texelFetch(nearest_other_depth, pixel, 0).x", "1.0"},
    {"the_last_faces_are_not_drawn", "sim/depth/begin_views.comp", "? face_count :", "? face_count - 12u :"},
    {"the_view_is_of_the_first_object", "sim/depth/begin_views.comp", "other < 256u", "other < 1u"},
};

/// Of responses.
inline constexpr Mutant kResponseMutants[] = {
    {"handles_push_without_velocity", "sim/collision/contact_plane.glsl",
     "(patch_.held.xyz + other.held.xyz) / pinned", "vec3(0.0)"},
    {"faces_that_do_not_enter_count_alike", "sim/collision/sum_contacts.comp", "0.5 * kWeightOfOthers",
     "0.5"},
    {"normals_of_the_other_side_add_up", "sim/collision/contact_plane.glsl", "patch_.area_normal.xyz - other",
     "patch_.area_normal.xyz + other"},
    {"shares_are_not_divided", "sim/collision/sum_contacts.comp", "(corners[k].w * shares)", "corners[k].w"},
    {"shares_forget_an_object", "sim/collision/count_shares.comp", "row.first_pair + row.pair_count",
     "row.first_pair + max(row.pair_count, 1u) - 1u"},
    {"what_parts_responds", "sim/collision/respond.comp", "count == 0u || approach <= 0.0", "count == 0u"},
    {"nothing_bounces", "sim/collision/plan_responses.comp", "> resting_speed ? restitution",
     "> resting_speed ? 0.0"},
    {"friction_pushes", "sim/collision/plan_responses.comp", "sliding * (-braking", "sliding * (braking"},
    {"the_lighter_side_takes_all", "sim/collision/plan_responses.comp",
     "min(approach.impulse, other.impulse)", "approach.impulse"},
    {"nodes_stay_where_they_went", "sim/collision/respond.comp", "position.xyz - way_back", "position.xyz"},
    {"the_contact_stands_still", "sim/collision/respond.comp", " - time_step * response.velocity.xyz", ""},
};

/// Of the detection of self-collision.
inline constexpr Mutant kSelfCollisionMutants[] = {
    {"a_chunk_forgets_lanes", "sim/collision/fit_rest_shapes.comp", "l < 64u", "l < 32u"},
    {"the_map_is_of_the_first_chunk", "sim/collision/fit_rest_shapes.comp", "c < end; ++c",
     "c < first + 1u; ++c"},
    {"the_map_is_transposed", "sim/collision/fit_rest_shapes.comp", "mat3 map = moment *",
     "mat3 map = transpose(moment) *"},
    {"lists_are_not_emptied", "sim/collision/find_restless_objects.comp", "work <= kRestlessChunks",
     "work < kRestless"},
    {"few_nodes_tell_of_all", "sim/collision/find_restless_objects.comp", "k < chunk.z", "k < 4u"},
    {"maps_stay_where_they_were", "sim/collision/find_restless_objects.comp",
     "+ (position(chunk.w) - fit.origin.xyz)", ""},
    {"least_clearance_is_forgotten", "sim/collision/fit_rest_shapes.comp",
     "half_stretch * rest.inverse_moment_y.w", "1e3"},
    {"contacts_are_kept", "sim/collision/list_restless_chunks.comp", "> 1u", "> 0u"},
    {"calm_objects_are_listed", "sim/collision/list_restless_chunks.comp", "> 1u", "> 1000u"},
    {"everything_is_calm", "sim/collision/list_restless_faces.comp", "is_calm[f] = calm ? 1u : 0u;",
     "calm = true; is_calm[f] = 1u;"},
    {"two_corners_are_calm", "sim/collision/list_restless_faces.comp", "corner < 3", "corner < 2"},
    {"clearance_is_forgotten", "sim/collision/list_restless_faces.comp", "texelFetch(clearances, int(f)).x",
     "1e3"},
    {"counts_are_not_cleared", "sim/collision/list_restless_faces.comp", "contact_counts[f] = 0u;", ""},
    {"pairs_are_found_twice", "sim/collision/walk_own_trees.comp", "bool mine = other > face ||",
     "bool mine = true ||"},
    {"calm_faces_are_not_found", "sim/collision/walk_own_trees.comp", "|| is_calm[other] != 0u", ""},
    {"leaves_of_three", "sim/collision/walk_own_trees.comp", "i < 4u", "i < 3u"},
    {"neighbours_touch", "sim/collision/own_tree.glsl", "return !neighbour &&", "return"},
    {"walks_skip_too_far", "sim/collision/own_tree.glsl", "near ? walk.node + 1u : node.x", "node.x"},
    {"one_face_of_two_is_told", "sim/collision/test_own_face_pairs.comp",
     "count_contact(face_pair.other_face);", ""},
};

/// Of responses to self-collision.
inline constexpr Mutant kSelfResponseMutants[] = {
    {"nodes_keep_their_velocity", "sim/collision/respond_to_self.comp",
     "velocities[n].xyz += velocity / shares;", ""},
    {"nodes_do_not_go_back", "sim/collision/respond_to_self.comp",
     "positions[n].xyz += displacement / shares;", ""},
    {"answers_are_not_averaged", "sim/collision/respond_to_self.comp", "velocity / count", "velocity"},
    {"masses_are_not_divided", "sim/collision/respond_to_self.comp",
     "lump.mass /= float(max(contact_counts[f], 1u));", ""},
    {"friction_is_forgotten_inside", "sim/collision/respond_to_self.comp", "friction * impulse", "0.0"},
    {"bounces_are_forgotten_inside", "sim/collision/respond_to_self.comp", "? restitution : 0.0",
     "? 0.0 : 0.0"},
    {"parting_faces_are_pulled", "sim/collision/respond_to_self.comp", "!(approach > 0.0) ||", ""},
    {"pinned_nodes_move", "sim/collision/respond_to_self.comp", "|| positions[n].w == 0.0", ""},
};

/// A broken search for what is near.
inline constexpr Mutant kProximityMutants[] = {
    {"the_margin_is_forgotten", "sim/collision/box_margin.glsl", "return box_margin.x +", "return"},
    {"a_box_has_one_end", "sim/proximity/proximities.glsl", "min(a - margin_at(a), b - margin_at(b))",
     "a - margin_at(a)"},
    {"counts_are_not_cleared", "sim/proximity/begin_proximities.comp", "starts[index] = 0u;", ";"},
    {"the_last_leaf_does_not_search", "sim/proximity/list_near_objects.comp", "leaf >= search_count",
     "leaf + 1u >= search_count"},
    {"the_own_object_is_forgotten", "sim/proximity/list_near_objects.comp", "++last;", ""},
    {"the_own_object_comes_first", "sim/proximity/list_near_objects.comp", ".other < own) ++",
     ".other < 0u) ++"},
    {"a_walk_ends_early", "sim/proximity/walk_near_objects.comp", "while (n < end)", "while (n + 1u < end)"},
    {"leaves_are_listed_in_one_place", "sim/proximity/walk_near_objects.comp",
     "near_object.first_near + count", "near_object.first_near"},
    {"walks_share_a_list", "sim/proximity/list_proximity_tasks.comp", "next += near_objects[k].near_count;",
     ""},
    {"the_last_leaves_have_no_task", "sim/proximity/list_proximity_tasks.comp", "(count + kLeavesATask - 1u)",
     "max(count, kLeavesATask)"},
    {"a_task_forgets_its_last_leaf", "sim/proximity/test_proximities.comp", "k < task.near_count &&",
     "k + 1u < task.near_count &&"},
    {"edges_are_near_their_neighbours", "sim/proximity/test_proximities.comp", "!share && ", ""},
    {"nodes_are_near_their_faces", "sim/proximity/test_proximities.comp", "!is_corner && ", ""},
    {"two_leaves_have_the_same_bits", "sim/proximity/test_proximities.comp", "16u * (k % 2u)", "0u"},
    {"the_radius_is_larger", "sim/proximity/test_proximities.comp", "< squared_radius",
     "< 1.01 * squared_radius"},
    {"a_bit_is_taken_twice", "sim/proximity/proximity_task.glsl", "word & (word - 1u)",
     "word & (word << 1u)"},
    {"edges_are_told_different_things", "sim/proximity/proximity_task.glsl",
     "texelFetch(face_edges, int(min(edge, other))), f = texelFetch(face_edges, int(max(edge, other)))",
     "texelFetch(face_edges, int(edge)), f = texelFetch(face_edges, int(other))"},
    {"a_group_forgets_lanes", "sim/proximity/sum_proximities.comp", "reach < 256u", "reach < 128u"},
    {"groups_start_anew", "sim/proximity/sum_proximities.comp", "at += group_sums[query / kQueriesAGroup];",
     ""},
    {"tasks_write_over_one_another", "sim/proximity/write_proximities.comp", "place += count_hits(before);",
     ";"},
    {"the_mirror_keeps_its_way", "sim/proximity/write_proximities.comp", "vec4(-apart, 0.0)",
     "vec4(apart, 0.0)"},
    {"the_mirror_keeps_its_weights", "sim/proximity/write_proximities.comp", "vec4(1.0 - t, t, 1.0 - s, s)",
     "vec4(1.0 - s, s, 1.0 - t, t)"},
    {"the_nearest_is_the_last", "sim/proximity/write_proximities.comp", "min(least, proximity.distance)",
     "proximity.distance"},
};

/// A broken marking of faces that touch.
inline constexpr Mutant kMarkMutants[] = {
    {"the_first_pair_alone_counts", "sim/collision/face_collisions.glsl", "k < row.pair_count",
     "k < min(row.pair_count, 1u)"},
    {"no_guard_behind_the_marks", "sim/view/mark_faces.comp", "if (f >= face_count) return;", ""},
    {"faces_without_a_touch_stay_as_they_were", "sim/view/mark_faces.comp", "marks[f] = uint(",
     "if (collides_with_any(pair_rows[faces[f].object], f)) marks[f] = uint("},
};

}  // namespace gelatin::test
