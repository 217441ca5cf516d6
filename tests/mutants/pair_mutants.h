#pragma once

#include "gpu/support/mutants.h"

namespace gelatin::test {

/// Pairs of surfaces that may come near each other in a part of an implicit step.
inline constexpr Mutant kFindPairsMutants[] = {
    {"paths_are_always_new", "sim/implicit/find_paths.comp", "clock[0].guards == 0u", "true"},
    {"means_of_wrong_counts", "sim/implicit/find_paths.comp", "max(nodes.y - nodes.x, 1u)", "nodes.y"},
    {"boxes_have_no_slack", "sim/implicit/path_boxes.glsl", "(1.0 + kPathSlack) *", "1.0 *"},
    {"boxes_forget_the_end", "sim/implicit/path_boxes.glsl", "to = path_end(node)", "to = position(node)"},
    {"bounds_do_not_move", "sim/implicit/path_trees.glsl",
     "swept(tree_bounds(root_of(object)), motion_of(object))", "tree_bounds(root_of(object))"},
    {"colliders_have_slots", "sim/implicit/find_slots.comp", "(is_body(o) || is_body(other))", "true"},
    {"bodies_never_meet_themselves", "sim/implicit/find_slots.comp",
     "is_near = is_body(o) && may_meet_itself(o)", "is_near = false"},
    {"convex_bodies_always_meet_themselves", "sim/implicit/own_pairs.glsl", "|| has_lost(object)", "|| true"},
    {"fast_objects_are_searched", "sim/implicit/place_slots.comp", "fastest > kFastest", "fastest > 1e30"},
    {"slots_without_place_go_on", "sim/implicit/place_slots.comp", "count > slot_capacity", "false"},
    {"the_last_leaf_does_not_search", "sim/implicit/find_searches.comp", "k < end &&", "k + 1u < end &&"},
    {"searches_do_not_move", "sim/implicit/find_searches.comp", "beside = motion - motion_of(slot.y)",
     "beside = vec3(0.0)"},
    {"walks_do_not_move", "sim/implicit/find_leaf_pairs.comp", "motion_of(slot.x) - motion_of(slot.y)",
     "vec3(0.0)"},
    {"what_is_lost_is_everywhere", "sim/implicit/find_leaf_pairs.comp",
     "slot.x == slot.y && is_convex(slot.x)", "false"},
    {"groups_of_lists_begin_at_0", "sim/implicit/list_starts.glsl",
     "+ texelFetch(group_sums, int(k / kCountsAGroup)).x", ""},
    {"lists_without_place_go_on", "sim/implicit/place_lists.comp", "return !is_full;", "return true;"},
    {"edges_meet_twice", "sim/implicit/test_leaf_pairs.comp", "slot.y > slot.x", "true"},
    {"edges_meet_themselves", "sim/implicit/test_leaf_pairs.comp", "second <= element.number", "false"},
    {"nodes_meet_their_faces", "sim/implicit/test_leaf_pairs.comp",
     "!any(equal(nodes, uvec3(element.nodes.x)))", "true"},
    {"elements_do_not_move", "sim/implicit/test_leaf_pairs.comp",
     "motion_of(pair.object) - motion_of(pair.other)", "vec3(0.0)"},
    {"ends_are_not_tested", "sim/implicit/test_leaf_pairs.comp", "at.normal) > wanted;",
     "at.normal) > -1e9;"},
    {"what_is_passed_is_ahead", "sim/implicit/test_leaf_pairs.comp",
     "max(pair.object, pair.other) >= body_count", "false"},
    {"bodies_are_passed_as_colliders_are", "sim/implicit/test_leaf_pairs.comp",
     "max(pair.object, pair.other) >= body_count", "true"},
    {"ways_are_halved_and_not_projected", "sim/implicit/test_leaf_pairs.comp", "if (time < 1.0) apart",
     "if (false) apart"},
    {"rounding_of_the_extent_alone", "sim/implicit/test_leaf_pairs.comp", "+ 4.0 * reach", ""},
    {"slots_end_where_they_begin", "sim/implicit/end_slots.comp", "first_pair(s + 1u)", "first_pair(s)"},
    {"rotations_are_forgotten", "sim/implicit/find_lost.comp", "transpose(rotation) *", ""},
    {"starts_keep_all", "sim/implicit/find_lost.comp", "keeps(positions, tet, inverse_, rotation) &&", ""},
    {"ends_keep_all", "sim/implicit/find_lost.comp", "&& keeps(path_ends, tet, inverse_, rotation)", ""},
    {"lost_boxes_have_a_corner_each", "sim/implicit/find_lost.comp", "k < 4; ++k", "k < 1; ++k"},
    {"what_grew_is_forgotten", "sim/implicit/find_lost.comp", "if (grew) counts", "if (false) counts"},
    {"calm_bodies_fall", "sim/implicit/find_paths.comp", "if (is_carried) d =", "if (false) d ="},
    {"all_bodies_are_carried", "sim/implicit/find_paths.comp", "texelFetch(paces, 5 * int(o)).x != kMoving",
     "true"},
};

}  // namespace gelatin::test
