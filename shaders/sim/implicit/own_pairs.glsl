// Where bodies may meet themselves. One that is convex at the start and has kept its distances does not; where it has lost some, only
// what the lines between would cross it there. CPU twins: gelatin::cpu::FindPairs, gelatin::cpu::KeptDistances.
#include "sim/implicit/path_trees.glsl"

uniform usamplerBuffer convex_bodies;  // by object: 1: it is
uniform usamplerBuffer lost_boxes;     // by object, two texels: round what lost distances, at the start; ordered bits
uniform samplerBuffer rest_boxes;      // of nodes of trees, at the start
uniform uint finds_own;                // 1: bodies meet themselves

bool is_convex(uint object) { return texelFetch(convex_bodies, int(object)).x != 0u; }

// From bits that ascend as numbers do: shaders/sim/implicit/find_lost.comp.
vec3 from_ordered(uvec3 bits) { return uintBitsToFloat(bits ^ ((bits >> 31) - 1u | 0x80000000u)); }
uvec3 lost_bits(uint object, uint end) { return texelFetch(lost_boxes, int(2u * object + end)).xyz; }
bool has_lost(uint object) { return lost_bits(object, 0u).x <= lost_bits(object, 1u).x; }
Bounds lost_bounds(uint object) { return Bounds(from_ordered(lost_bits(object, 0u)), from_ordered(lost_bits(object, 1u))); }

bool may_meet_itself(uint object) { return finds_own != 0u && (!is_convex(object) || has_lost(object)); }

Bounds rest_bounds(uint node) {
    return Bounds(texelFetch(rest_boxes, int(2u * node)).xyz, texelFetch(rest_boxes, int(2u * node + 1u)).xyz);
}
