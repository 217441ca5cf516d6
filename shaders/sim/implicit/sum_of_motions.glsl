// What sum_motions.comp has found, over all chunks of an object, in the work group of 64 of one of them. To be included after
// sim/implicit/solve_system.glsl and sim/implicit/body_sums.glsl.
uniform samplerBuffer base_sums;  // ResidualSums of chunks, two texels each

ResidualSums sum_of_motions(uint object) {
    vec4 force = vec4(0.0), moment = vec4(0.0);
    uint end = texelFetch(chunk_starts, int(object) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(object)).x + gl_LocalInvocationID.x; c < end; c += 64u) {
        force += texelFetch(base_sums, 2 * int(c));
        moment += texelFetch(base_sums, 2 * int(c) + 1);
    }
    return sum_by_lanes(force, moment.xyz);
}
