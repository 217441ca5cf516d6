// What all but gravity exerts on held nodes of bodies where the last part ends, for who reads forces of pins; 0 on free ones. An
// invocation a node. CPU twin: gelatin::cpu::ImplicitStep::find_forces_on_held. Parity: tests/gpu/implicit/held_forces_test.cpp.
#define PRODUCTS
#include "include/global_index.glsl"
#include "sim/drive/load_force.glsl"
#include "sim/drive/pull.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/half_edges.glsl"
#include "sim/implicit/rows.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;      // where the part has ended, xyz [m]; w: inverse mass, 0: held
uniform samplerBuffer slips;          // of rows; w: limit of friction [N]
uniform usamplerBuffer entry_starts;  // of each node, and the end
uniform usamplerBuffer row_entries;   // 4 row + place of the node in it
uniform uint body_node_count;
layout(std430) readonly buffer Rows { StepRow rows[]; };
layout(std430) readonly buffer ElasticForces { vec4 elastic_forces[]; };  // where the part began [N]
layout(std430) writeonly buffer HeldForces { vec4 held_forces[]; };       // [N]

void main() {
    uint n = global_index();
    if (n >= body_node_count) return;
    vec4 x = texelFetch(positions, int(n));
    vec3 force = vec3(0.0), d = texelFetch(displacements, int(n)).xyz;
    if (x.w == 0.0) {
        force = elastic_forces[n].xyz - stiffness_times(n, d);
#ifdef LOADED
        force += load_force(n);
#endif
        if (is_pulled != 0u) force += pull_force_at_end(n, x.xyz, x.xyz - d, clock[0].last_step);
        uint end = texelFetch(entry_starts, int(n) + 1).x;
        for (uint e = texelFetch(entry_starts, int(n)).x; e < end; ++e) {
            uint entry = texelFetch(row_entries, int(e)).x, r = entry / 4u;
            vec3 s = relative(rows[r], displacements);
            force += rows[r].weights[entry % 4u] * force_at(rows[r], s, texelFetch(slips, int(r)).w);
        }
    }
    held_forces[n] = vec4(force, 0.0);
}
