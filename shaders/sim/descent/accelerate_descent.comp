// Chebyshev's semi-iterative method between the sweeps of block descent. Bodies that touch a collider are left alone:
// what holds them changes from sweep to sweep.
// CPU twin: gelatin::cpu::BlockDescent. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
layout(local_size_x = 64) in;

// An invocation reads and writes its own node.
layout(std430) buffer Positions { vec4 positions[]; };
layout(std430) buffer Starts { vec4 sweep_starts[]; };  // of the last two sweeps: all nodes, and again
layout(std430) readonly buffer ObjectTouches { uint object_touches[]; };
uniform usamplerBuffer node_objects;
uniform uint node_count;
uniform uint sweep;    // in this step
uniform float weight;  // w_k

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec4 x = positions[n];
    if (sweep > 1u && object_touches[texelFetch(node_objects, int(n)).x] == 0u) {
        vec3 before = sweep_starts[node_count + n].xyz;
        x.xyz = weight * (x.xyz - before) + before;
        positions[n] = x;
    }
    sweep_starts[node_count + n] = sweep_starts[n];
    sweep_starts[n] = x;
}
