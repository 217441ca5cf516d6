// Where a step begins: its clock, its nodes, and where held ones go by their velocities, one invocation a node. Held nodes that were
// blocked go on from where the last step has left them. And whether anything leaves its place: bodies rest together, or not at all.
// CPU twin: gelatin::cpu::SystemSolver. Parity: tests/gpu/implicit/part_start_test.cpp.
#include "include/global_index.glsl"
#include "layouts/rest_state.glsl"
#include "layouts/step_state.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer given_positions;   // xyz [m]; w: inverse mass, 0: held
uniform samplerBuffer given_velocities;  // xyz [m/s]
uniform uint node_count;
uniform float size;                // of the step [s]
uniform uint divides;
uniform uint keeps_held;           // 1: held ones go on from where the last step ended
uniform uint is_driven;            // 1: by what is no handle
uniform samplerBuffer rest_distances;  // of nodes from their places, at most [m]
layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) writeonly buffer Goals { vec4 goals[]; };  // of held nodes [m]
layout(std430) buffer Positions { vec4 positions[]; };
layout(std430) buffer Velocities { vec4 velocities[]; };
layout(std430) writeonly buffer HeldChanges { vec4 held_changes[]; };  // of their velocities [m/s]
layout(std430) buffer Rest { RestState rest[]; };
layout(std430) buffer Places { vec4 places[]; };  // [m]; w: inverse mass

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

// @param asked where the node is, or its handle wants it
bool is_restless(uint n, vec4 asked) {
    if (rest[0].takes_places != 0u) {
        places[n] = asked;
        return false;
    }
    vec3 apart = asked.xyz - places[n].xyz;
    float most = texelFetch(rest_distances, int(n)).x;
    return asked.w != places[n].w || dot(apart, apart) > most * most;
}

void main() {
    uint n = global_index();
    if (n == 0u) begin_clock();
    if (n >= node_count) return;
    vec4 x = texelFetch(given_positions, int(n)), v = texelFetch(given_velocities, int(n));
    bool is_held = x.w == 0.0, was_held = positions[n].w == 0.0;
    held_changes[n] = is_held && was_held ? vec4(v.xyz - velocities[n].xyz, 0.0) : vec4(0.0);
    velocities[n] = v;
    vec4 goal = is_held ? vec4(x.xyz + size * v.xyz, 0.0) : x;
    // Whoever writes it writes the same.
    if (is_driven != 0u || is_restless(n, goal)) rest[0].is_restless = 1u;
    if (is_held) {
        goals[n] = goal;
        if (keeps_held != 0u && was_held) return;
    }
    positions[n] = x;
}
