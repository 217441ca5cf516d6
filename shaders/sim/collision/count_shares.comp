// How many colliding faces a node has, over all objects that its own touches: the shares that its mass is cut into.
// CPU twin: gelatin::cpu::respond. Parity: tests/gpu/collision/respond_test.cpp.
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_collisions.glsl"
#include "sim/collision/node_faces.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer faces;  // Face
layout(std430) writeonly buffer NodeShares { uint node_shares[]; };

void main() {
    uint n = global_index();
    if (n >= dispatches[kNodes].count) return;
    uint shares = 0u;
    uint first = texelFetch(node_face_starts, int(n)).x;
    if (first != texelFetch(node_face_starts, int(n) + 1).x) {  // on the surface
        PairRow row = pair_rows[texelFetch(faces, int(texelFetch(node_faces, int(first)).x)).w];
        for (uint p = row.first_pair; p < row.first_pair + row.pair_count; ++p)
            shares += count_colliding(n, object_pairs[p]);
    }
    node_shares[n] = shares;
}
