// Where a step ends, or a try of it: velocities of held nodes are those of their handles. In parts they are what takes nodes to their
// goals, and far more where bodies are in the way. Where bodies rest, nothing has any. An invocation a node.
// CPU twin: gelatin::cpu::SystemSolver. Parity: tests/gpu/implicit/body_contacts_test.cpp.
#include "include/global_index.glsl"
#include "layouts/rest_state.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer given_velocities;  // as of begin_step.comp
uniform samplerBuffer positions;         // w: inverse mass, 0: held
uniform uint node_count;
layout(std430) readonly buffer Rest { RestState rest[]; };
layout(std430) buffer Velocities { vec4 velocities[]; };

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    if (rest[0].rests != 0u) velocities[n].xyz = vec3(0.0);
    else if (texelFetch(positions, int(n)).w == 0.0) velocities[n] = texelFetch(given_velocities, int(n));
}
