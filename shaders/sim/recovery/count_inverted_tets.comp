// How many tets of each object are inside out, or have no volume left. Where there are so many that an object may have lost its
// shape, the dispatches over nodes that match shapes get their work groups; else they stay empty.
// CPU twin: gelatin::cpu::ShapeMatcher. Parity: tests/gpu/recovery/match_shapes_test.cpp.
#define WRITES_INVERTED
#include "include/global_index.glsl"
#include "sim/recovery/inverted_tets.glsl"
#include "sim/elasticity/volume_ratio.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer node_objects;
uniform uint tet_count;
uniform uint chunk_groups;   // of match_shapes.comp: a chunk each
uniform uint node_groups;    // of place_shapes.comp

Dispatch make_dispatch(uint groups) {
    uint rows = (groups + 65534u) / 65535u;
    return Dispatch((groups + rows - 1u) / rows, rows, 1u, 0u);
}

void main() {
    uint t = global_index();
    if (t >= tet_count || volume_ratio(t) > 0.0) return;
    uint object = texelFetch(node_objects, int(texelFetch(tets, int(t)).x)).x;
    // The one tet with which they become too many.
    if (atomicAdd(inverted[object], 1u) != most_inverted(object)) return;
    match_dispatches[0] = make_dispatch(chunk_groups);
    match_dispatches[1] = make_dispatch(node_groups);
}
