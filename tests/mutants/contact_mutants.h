#pragma once

#include "gpu/support/mutants.h"

namespace gelatin::test {

/// Of sweeps with contacts.
inline constexpr Mutant kLimitedSweepMutants[] = {
    {"contacts_do_not_press", "sim/contact/node_contacts.glsl",
     "terms.force -= contact_force(gap, share.law.z, share.law.y) * share.towards.xyz;", ""},
    {"contacts_are_not_stiff", "sim/contact/node_contacts.glsl",
     "add_outer(share.law.x * contact_hessian(gap, share.law.z, share.law.y), share.towards.xyz, terms);",
     ""},
    {"the_gap_does_not_change", "sim/contact/node_contacts.glsl",
     "share.towards.w - share.law.x * dot(share.towards.xyz, displacement)", "share.towards.w"},
    {"there_is_no_barrier", "sim/contact/contact_law.glsl", "stiffness * (gap < 0.5 * reach ? barrier : max(",
     "stiffness * (gap < 0.0 ? barrier : max("},
    {"the_barrier_is_not_stiff", "sim/contact/contact_law.glsl", "gap < 0.5 * reach ? barrier : gap < reach",
     "gap < reach"},
    {"nothing_holds", "sim/contact/node_contacts.glsl", "terms.force -= part * hold;", ""},
    {"friction_is_not_stiff", "sim/contact/node_contacts.glsl", "terms.diagonal += across;", ""},
    {"friction_has_no_limit", "sim/contact/node_contacts.glsl",
     "float part = limit / max(sqrt(squared), limit);", "float part = 1.0;"},
    {"friction_presses", "sim/contact/node_contacts.glsl", "add_outer(-across, share.towards.xyz, terms);",
     ""},
    {"the_last_share_is_left_out", "sim/contact/node_contacts.glsl",
     "k < limits.first_share + limits.share_count; ++k) {\n        NodeShare share = node_shares[k];\n"
     "        float gap = gap_at(share, displacement);\n        add_contact",
     "k + 1u < limits.first_share + limits.share_count; ++k) {\n        NodeShare share = node_shares[k];\n"
     "        float gap = gap_at(share, displacement);\n        add_contact"},
    {"planes_do_not_stop", "sim/contact/node_contacts.glsl",
     "vec3 motion = kept_to_planes(limits, displacement, to - from);", "vec3 motion = to - from;"},
    {"planes_do_not_shorten", "sim/contact/node_contacts.glsl", "return part * motion;", "return motion;"},
    {"rooms_do_not_end", "sim/contact/node_contacts.glsl",
     "motion *= part_within_room(limits, from - limits.room.xyz, motion);", ""},
    {"rooms_do_not_follow_ways", "sim/contact/node_contacts.glsl",
     "clamp(dot(moved, way) / squared, 0.0, 1.0)", "0.0"},
    {"own_rooms_do_not_end", "sim/contact/node_contacts.glsl",
     "motion *= part_within(from - limits.own_room.xyz, motion, limits.own_room.w);", ""},
    {"nodes_go_through_planes", "sim/contact/node_contacts.glsl",
     "motion *= part_outside_planes(from, motion);", ""},
    {"no_line_search", "sim/contact/node_contacts.glsl",
     "motion *= least_along(limits, displacement, motion, all);", ""},
    {"the_search_forgets_the_body", "sim/contact/node_contacts.glsl",
     "float pull = dot(all.force, motion), curvature = dot(stretched, motion);",
     "float pull = 0.0, curvature = 0.0;"},
    {"what_is_near_goes_too_far", "sim/contact/node_contacts.glsl",
     "if (dot(ahead, ahead) <= limits.aimed_at.w) return to;", "return to;"},
    {"inner_nodes_are_limited", "sim/descent/descend.comp", "if (entry.w != 0xFFFFFFFFu) limits", "limits"},
};

}  // namespace gelatin::test
