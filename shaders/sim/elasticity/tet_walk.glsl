// A node's walk along its strip of neo-Hookean tets, at `positions`, a buffer texture that must be declared before.
#include "sim/elasticity/neo_hookean.glsl"

struct TetWalk {
    uint step, end;      // the present step and the end of those of the node's slice
    NeoHookeanStep tet;  // of the step; its number is kNone where the step only brings a node in
    int node;            // that comes in with the step
    Strip strip;         // positions less that of the walk's own node [m]
};

// Before the first tet of the node of a row of slices.
TetWalk begin_tet_walk(uint row) {
    TetWalk walk;
    walk.step = texelFetch(neo_hookean_starts, int(row / kSlice)).x + row % kSlice - kSlice;
    walk.end = texelFetch(neo_hookean_starts, int(row / kSlice) + 1).x;
    walk.strip = kNoStrip;
    return walk;
}

// Goes on by a step. @return false: there is none
bool walk_on(vec3 position, inout TetWalk walk) {
    walk.step += kSlice;
    if (walk.step >= walk.end) return false;
    walk.tet = fetch_neo_hookean_step(walk.step);
    if (walk.tet.vertex == kNone) return false;
    walk.node = node_of(walk.tet.vertex);
    step_strip(walk.tet.vertex, texelFetch(positions, walk.node).xyz - position, walk.strip);
    return true;
}
