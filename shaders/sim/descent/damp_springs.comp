// Springs with their dampers as springs without, which they are for the length of a step: with k the stiffness, t the
// damping time, h the step and l_0 how long the spring is when it begins, K = k (1 + t / h) and
// M = (L + t / h l_0) / (1 + t / h). One invocation a row of descend.comp.
// CPU twin: gelatin::cpu::damp_springs. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "sim/descent/descent_step.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer rows;          // DescentRow
uniform usamplerBuffer spring_ends;   // of two half springs, the nodes at their other ends
uniform samplerBuffer springs;        // their rest length [m], stiffness [N/m]
uniform usamplerBuffer slice_starts;
layout(std430) writeonly buffer DampedSprings { vec4 damped_springs[]; };
uniform uint row_count;

struct Node {
    vec3 start;          // [m]
    float damping_time;  // [s]
};

Node fetch_node(uint n) {
    return Node(texelFetch(start_positions, int(n)).xyz, texelFetch(start_velocities, int(n)).w);
}

// @param spring rest length, stiffness
vec2 damped(Node a, Node b, vec2 spring) {
    float damping = 0.5 * (a.damping_time + b.damping_time) / time_step;
    return vec2((spring.x + damping * distance(a.start, b.start)) / (1.0 + damping), spring.y * (1.0 + damping));
}

void main() {
    uint row = global_index();
    if (row >= row_count) return;
    uvec2 entry = texelFetch(rows, int(row)).xz;
    uint n = entry.x;
    if (n == 0xFFFFFFFFu) return;
    Node self = fetch_node(n);
    uint first = texelFetch(slice_starts, int(row / 64u)).x + row % 64u, end = first + 64u * entry.y;
    for (uint p = first; p < end; p += 64u) {
        uvec2 ends = texelFetch(spring_ends, int(p)).xy;
        vec4 two = texelFetch(springs, int(p));
        damped_springs[p] = vec4(damped(self, fetch_node(ends.x), two.xy), damped(self, fetch_node(ends.y), two.zw));
    }
}
