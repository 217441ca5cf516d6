// The pairs that the guard of pairs checks, and the nodes that it moves. CPU twin: gelatin::cpu::Guard.
#include "include/global_index.glsl"
#include "layouts/contact_tuning.glsl"
#include "layouts/near_pair.glsl"
#include "layouts/pair_guard.glsl"
#include "sim/implicit/clock.glsl"

const uint kStays = 1u << 31u;  // NodeClips::rounds: the node stays where it is in the frame
// Of an object; the last two of an island, at its first object.
const uint kIsBlocked = 1u;     // what is held of it stays where it is
const uint kHasBlocked = 2u;
const uint kHasFailed = 4u;     // all of it goes with the frame

uniform samplerBuffer positions;     // where the part began: xyz [m]; w: inverse mass, 0: held
uniform samplerBuffer wanted;        // where the guard began [m]; w as above
uniform samplerBuffer frames;        // of objects, xyz: what their islands have in common [m]
uniform usamplerBuffer near_pairs;   // NearPair, five texels each
uniform usamplerBuffer node_objects; // of each node: twice its object, and 1 more on a surface
uniform usamplerBuffer guard_islands;  // of each object: the first object of those that have pairs in common
uniform uint node_count;
uniform uint round_;

vec3 start_of(uint n) { return texelFetch(positions, int(n)).xyz; }
bool is_held(uint n) { return texelFetch(positions, int(n)).w == 0.0; }
uint object_of(uint n) { return texelFetch(node_objects, int(n)).x / 2u; }
uint island_of(uint object) { return texelFetch(guard_islands, int(object)).x; }
vec3 frame_of(uint object) { return texelFetch(frames, int(object)).xyz; }

struct GuardedPair {
    uvec4 nodes;
    vec3 normal;
    float gap;
    float rounding;
    float reach;
    bool is_edges;
    uint object;
    uint other;
};

GuardedPair fetch_pair(uint p) {
    int at = 5 * int(p);
    vec4 normal = uintBitsToFloat(texelFetch(near_pairs, at + 2));
    uvec4 last = texelFetch(near_pairs, at + 4);
    return GuardedPair(texelFetch(near_pairs, at), normal.xyz, normal.w, uintBitsToFloat(last.w), uintBitsToFloat(last.z),
                       texelFetch(near_pairs, at + 3).z != 0u, last.x, last.y);
}

bool is_first(GuardedPair pair, uint k) { return k < (pair.is_edges ? 2u : 1u); }
