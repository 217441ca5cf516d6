// The value that colours show at each node, one invocation for each node: the mean over its tets, weighted by their volumes at
// rest; with SPEED the node's own speed [m/s], which the histogram counts for nodes without tets, those of rigid bodies. Test: tests/gpu/view/tet_values_test.cpp.
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
#ifdef SPEED
uniform samplerBuffer rest_positions;  // xyz [m], inverse mass [1/kg], 0 for colliders
layout(std430) buffer Histogram { uint histogram[]; };

bool has_tets(uint n) {
    uint slice = n / kSlice, entry = texelFetch(slice_starts, int(slice)).x + n % kSlice;
    return entry < texelFetch(slice_starts, int(slice) + 1).x && texelFetch(node_tets, int(entry)).x != kNone;
}
#endif

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
    float speed = length(texelFetch(velocities, int(n)).xyz);
    node_values[n] = speed;
    if (texelFetch(rest_positions, int(n)).w > 0.0 && !has_tets(n))
        atomicAdd(histogram[min(floatBitsToUint(speed) >> kBinShift, kBins - 1u)], 1u);
#else
    node_values[n] = mean_over_tets(n);
#endif
}
