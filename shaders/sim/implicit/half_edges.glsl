// The edges of each node, and their matrices.
#include "layouts/packing.glsl"

uniform usamplerBuffer half_edges;        // 2 edge, + 1 from its upper node; the other node. In slices of 64 nodes; kNone pads
uniform usamplerBuffer half_edge_starts;  // of the slices
uniform samplerBuffer matrices;           // EdgeMatrix, three texels each

mat3x4 fetch_matrix(uint half_edge) {
    int first = 3 * int(half_edge / 2u);
    return mat3x4(texelFetch(matrices, first), texelFetch(matrices, first + 1), texelFetch(matrices, first + 2));
}

#ifdef PRODUCTS
#ifndef FIELD_AT
uniform samplerBuffer displacements;  // d, xyz [m]
#define FIELD_AT(n) texelFetch(displacements, int(n)).xyz
#endif

// K d: what the forces of elements on a node change by as nodes move, reversed [N].
vec3 stiffness_times(uint n, vec3 own) {
    vec3 sum = vec3(0.0);
    uint end = texelFetch(half_edge_starts, int(n / kSlice) + 1).x;
    for (uint k = texelFetch(half_edge_starts, int(n / kSlice)).x + n % kSlice; k < end; k += kSlice) {
        uvec2 half_edge = texelFetch(half_edges, int(k)).xy;
        if (half_edge.x == kNone) break;
        vec3 change = own - FIELD_AT(half_edge.y);
        mat3 matrix = mat3(fetch_matrix(half_edge.x));
        sum += half_edge.x % 2u == 0u ? matrix * change : change * matrix;
    }
    return sum;
}
#endif
