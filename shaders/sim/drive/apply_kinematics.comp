// Sets the nodes of handles to their positions at the start of a step, with the velocities that take them to those at its end;
// gives released nodes their mass back. One invocation for each node. CPU twin: gelatin::cpu::apply_kinematics. Parity:
// tests/gpu/drive/apply_kinematics_test.cpp.
#include "include/global_index.glsl"
#include "layouts/handle.glsl"
#include "layouts/packing.glsl"
layout(local_size_x = 64) in;

layout(std430) buffer Positions { vec4 positions[]; };    // an invocation reads and writes its own node
layout(std430) buffer Velocities { vec4 velocities[]; };  // alone
layout(std430) readonly buffer HandleNodes { HandleNode handle_nodes[]; };
layout(std430) readonly buffer Motions { HandleMotion motions[]; };
layout(std430) readonly buffer Animated { NodeMotion animated[]; };
uniform uint held_count;

void main() {
    uint k = global_index();
    if (k >= held_count) return;
    HandleNode held = handle_nodes[k];
    HandleMotion motion = motions[held.handle];
    uint n = held.node;
    if (motion.center.w == 0.0) {
        positions[n].w = held.arm.w;
        return;
    }
    if (held.animated != kNone) {
        positions[n] = vec4(animated[held.animated].start.xyz, 0.0);
        velocities[n].xyz = animated[held.animated].velocity.xyz;
        return;
    }
    vec3 arm = held.arm.xyz;
    mat3 map = mat3(motion.map_x.xyz, motion.map_y.xyz, motion.map_z.xyz);
    mat3 rate = mat3(motion.rate_x.xyz, motion.rate_y.xyz, motion.rate_z.xyz);
    positions[n] = vec4(map * arm + motion.center.xyz, 0.0);
    velocities[n].xyz = rate * arm + motion.velocity.xyz;
}
