// What all but rows exerts on bodies as rigid ones, by chunk, whose nodes a work group of kLanes sums.
// CPU twin: gelatin::cpu::IslandSolve::gather_base.
layout(std430) writeonly buffer BaseSums { ResidualSums base_sums[]; };

ResidualSums sum_by_lanes(vec4 force, vec3 moment);
vec3 base_at(uint n, uint island, vec4 load);  // of a kernel [N]

// Where a solve begins: elements hardly resist rigid motions.
vec3 first_base(vec4 load, vec3 d) { return load.xyz - load.w * d; }

void sum_base(uint c, uint island) {
    uvec4 chunk = texelFetch(chunks, int(c));
    vec3 center = center_of(chunk.x), force = vec3(0.0), moment = vec3(0.0);
    for (uint n = chunk.y + gl_LocalInvocationID.x; n < chunk.y + chunk.z; n += kLanes) {
        vec4 load = texelFetch(loads, int(n));
        if (!(load.w > 0.0)) continue;
        vec3 base = base_at(n, island, load);
        force += base;
        moment += cross(texelFetch(positions, int(n)).xyz - center, base);
    }
    ResidualSums sum = sum_by_lanes(vec4(force, 0.0), moment);
    if (gl_LocalInvocationID.x == 0u) base_sums[c] = sum;
}
