// Forces of elements on nodes, and what their stiffness has on its diagonal, one invocation a node.
// CPU twin: gelatin::cpu::ElasticSystem. Parity: tests/gpu/implicit/elastic_system_test.cpp.
#include "include/global_index.glsl"
#include "layouts/element_edge.glsl"
#include "sim/implicit/half_edges.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer node_tets;        // 4 t + corner, in slices of 64 nodes; kNone pads
uniform usamplerBuffer node_tet_starts;  // of the slices
uniform samplerBuffer tet_rows;          // four a tet
layout(std430) writeonly buffer Forces { vec4 forces[]; };  // [N]
layout(std430) writeonly buffer Blocks { NodeBlock blocks[]; };
uniform uint node_count;

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec3 force = vec3(0.0), diagonal = vec3(0.0), beside = vec3(0.0);
    uint end = texelFetch(half_edge_starts, int(n / kSlice) + 1).x;
    for (uint k = texelFetch(half_edge_starts, int(n / kSlice)).x + n % kSlice; k < end; k += kSlice) {
        uint half_edge = texelFetch(half_edges, int(k)).x;
        if (half_edge == kNone) break;
        mat3x4 m = fetch_matrix(half_edge);
        vec3 pull = vec3(m[0].w, m[1].w, m[2].w);
        force += half_edge % 2u == 0u ? pull : -pull;
        diagonal += vec3(m[0].x, m[1].y, m[2].z);
        beside += 0.5 * vec3(m[1].z + m[2].y, m[2].x + m[0].z, m[0].y + m[1].x);
    }
    end = texelFetch(node_tet_starts, int(n / kSlice) + 1).x;
    for (uint k = texelFetch(node_tet_starts, int(n / kSlice)).x + n % kSlice; k < end; k += kSlice) {
        uint entry = texelFetch(node_tets, int(k)).x;
        if (entry == kNone) break;
        vec4 row = texelFetch(tet_rows, int(entry));
        force -= row.w * row.xyz;
    }
    forces[n] = vec4(force, 0.0);
    blocks[n] = NodeBlock(vec4(diagonal, 0.0), vec4(beside, 0.0));
}
