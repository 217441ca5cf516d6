// The pairs of faces of one object whose boxes meet, in no particular order: each restless face walks through its object's
// tree. Of two restless faces the first one lists the pair. CPU twin: gelatin::cpu::FindSelfCollisions. Parity:
// tests/gpu/collision/find_self_collisions_test.cpp.
#define WRITES_DISPATCHES
#include "include/global_index.glsl"
#include "sim/collision/own_tree.glsl"
#include "layouts/object_pair.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer RestlessFaces { uint restless[]; };
layout(std430) readonly buffer Calm { uint is_calm[]; };
layout(std430) writeonly buffer FacePairs { FacePair face_pairs[]; };
uniform uint face_pair_capacity;

void main() {
    uint k = global_index();
    if (k >= dispatches[kRestless].count) return;
    uint face = restless[k];
    OwnWalk walk = start_walk(face);
    while (walk.node < walk.end) {
        uvec2 leaf = next_leaf(walk);
        uint found = 0u;
        for (uint i = 0u; i < 4u; ++i) {
            uint other = leaf.x + min(i, max(leaf.y, 1u) - 1u);
            bool mine = other > face || is_calm[other] != 0u;
            found |= uint(i < leaf.y && mine && is_near(walk, other)) << i;
        }
        while (found != 0u) {
            uint slot = take_slot(kSelfPairs, face_pair_capacity);
            if (slot != kNone) face_pairs[slot] = FacePair(0u, face, leaf.x + uint(findLSB(found)), 0u);
            found &= found - 1u;
        }
    }
}
