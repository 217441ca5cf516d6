// K d, one invocation a node.
// CPU twin: gelatin::cpu::ElasticSystem. Parity: tests/gpu/implicit/elastic_system_test.cpp.
#define PRODUCTS
#include "include/global_index.glsl"
#include "sim/implicit/half_edges.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer Products { vec4 products[]; };  // [N]
uniform uint node_count;

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    products[n] = vec4(stiffness_times(n, texelFetch(displacements, int(n)).xyz), 0.0);
}
