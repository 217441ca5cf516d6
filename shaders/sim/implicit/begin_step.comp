// Where a step begins: its clock, its nodes, and where held ones go by their velocities, one invocation a node. Held nodes that were
// blocked go on from where the last step has left them.
// CPU twin: gelatin::cpu::SystemSolver. Parity: tests/gpu/implicit/part_start_test.cpp.
#include "include/global_index.glsl"
#include "layouts/step_state.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer given_positions;   // xyz [m]; w: inverse mass, 0: held
uniform samplerBuffer given_velocities;  // xyz [m/s]
uniform uint node_count;
uniform float size;                // of the step [s]
uniform uint divides;
uniform uint keeps_held;           // 1: held ones go on from where the last step ended
layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) writeonly buffer Goals { vec4 goals[]; };  // of held nodes [m]
layout(std430) buffer Positions { vec4 positions[]; };
layout(std430) buffer Velocities { vec4 velocities[]; };
layout(std430) writeonly buffer HeldChanges { vec4 held_changes[]; };  // of their velocities [m/s]

void begin_clock() {
    StepClock now = clock[0];  // what parts pass on goes on
    now.size = size;
    now.left = size;
    now.longest = size;
    now.step = size;
    now.is_over = 0u;
    now.goes_on = 0u;
    now.damps = 0u;
    now.divides = divides;
    now.tries = 0u;
    now.made = 0u;
    now.begun = 0u;
    now.dropped_rows = 0u;
    now.guards = 0u;
    clock[0] = now;
}

void main() {
    uint n = global_index();
    if (n == 0u) begin_clock();
    if (n >= node_count) return;
    vec4 x = texelFetch(given_positions, int(n)), v = texelFetch(given_velocities, int(n));
    bool is_held = x.w == 0.0, was_held = positions[n].w == 0.0;
    held_changes[n] = is_held && was_held ? vec4(v.xyz - velocities[n].xyz, 0.0) : vec4(0.0);
    velocities[n] = v;
    if (is_held) {
        goals[n] = vec4(x.xyz + size * v.xyz, 0.0);
        if (keeps_held != 0u && was_held) return;
    }
    positions[n] = x;
}
