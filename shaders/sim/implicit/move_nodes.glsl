// Nodes of a chunk move with their body as a rigid one; a work group of kLanes.
// CPU twin: gelatin::cpu::IslandSolve::rigid_newton.
layout(std430) buffer Displacements { vec4 displacements[]; };  // d [m]

void move_nodes(uvec4 chunk, BodyMotion motion) {
    if (!(texelFetch(bodies, 5 * int(chunk.x)).w > 0.0)) return;
    vec3 center = center_of(chunk.x);
    for (uint n = chunk.y + gl_LocalInvocationID.x; n < chunk.y + chunk.z; n += kLanes)
        displacements[n].xyz += at_node(motion, center, n);
}
