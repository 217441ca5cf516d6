// Where a side of a row is on its body as a rigid one.
// CPU twin: gelatin::cpu::RigidSolve.

// From the body's centre; 0 on a body that does not move as a rigid one [m].
vec3 arm_of(StepRow row, uint object, bool is_first) {
    vec3 arm = vec3(0.0);
    if (object >= object_count || !(texelFetch(bodies, 5 * int(object)).w > 0.0)) return arm;
    uvec4 nodes = nodes_of(row);
    for (int k = 0; k < 4; ++k)
        if (row.weights[k] != 0.0 && (row.weights[k] < 0.0) == is_first)
            arm += abs(row.weights[k]) * (texelFetch(positions, int(nodes[k])).xyz - center_of(object));
    return arm;
}
