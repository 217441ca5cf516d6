// What colours show at each node, one invocation a node: the mean over its tets, weighted by their volumes at rest; with
// SPEED the node's own speed [m/s]. Test: tests/gpu/view/tet_values_test.cpp.
#include "layouts/packing.glsl"
#include "include/global_index.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer tet_values;
uniform samplerBuffer velocities;     // xyz [m/s]
uniform usamplerBuffer node_tets;     // 4 tet + corner, in slices of nodes; kNone pads
uniform usamplerBuffer slice_starts;  // of the slices
uniform samplerBuffer tet_materials;  // volume at rest [m^3], shear modulus [Pa]
layout(std430) writeonly buffer NodeValues { float node_values[]; };
uniform uint node_count;


float mean_over_tets(uint n) {
    float sum = 0.0, volume = 0.0;
    uint end = texelFetch(slice_starts, int(n / kSlice) + 1).x;
    for (uint e = texelFetch(slice_starts, int(n / kSlice)).x + n % kSlice; e < end; e += kSlice) {
        uint entry = texelFetch(node_tets, int(e)).x;
        if (entry == kNone) break;
        float weight = texelFetch(tet_materials, int(entry / 4u)).x;
        sum += weight * texelFetch(tet_values, int(entry / 4u)).x;
        volume += weight;
    }
    return volume > 0.0 ? sum / volume : 0.0;
}

void main() {
    uint n = global_index();
    if (n >= node_count) return;
#ifdef SPEED
    node_values[n] = length(texelFetch(velocities, int(n)).xyz);
#else
    node_values[n] = mean_over_tets(n);
#endif
}
