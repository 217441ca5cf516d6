// Puts the nodes of handles where a step begins, with the velocities that take them to where it ends; gives released
// ones their mass back. One invocation a node.
// CPU twin: gelatin::cpu::apply_kinematics. Parity: tests/gpu/drive/apply_kinematics_test.cpp.
#include "include/global_index.glsl"
#include "layouts/handle.glsl"
layout(local_size_x = 64) in;

layout(std430) buffer Positions { vec4 positions[]; };    // an invocation reads and writes its own node
layout(std430) buffer Velocities { vec4 velocities[]; };  // alone
layout(std430) readonly buffer HandleNodes { HandleNode handle_nodes[]; };
layout(std430) readonly buffer Motions { HandleMotion motions[]; };
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
    vec3 arm = held.arm.xyz;
    mat3 map = mat3(motion.map_x.xyz, motion.map_y.xyz, motion.map_z.xyz);
    mat3 rate = mat3(motion.rate_x.xyz, motion.rate_y.xyz, motion.rate_z.xyz);
    positions[n] = vec4(map * arm + motion.center.xyz, 0.0);
    velocities[n].xyz = rate * arm + motion.velocity.xyz;
}
