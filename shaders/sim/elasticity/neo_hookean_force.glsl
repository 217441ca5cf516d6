// Forces of neo-Hookean tets where explicit solvers need them: at `positions` with `velocities`, buffer textures that are
// declared before. DAMPED: some damping time is not zero. CPU twin: cpu::gather_tet_forces, src/cpu/explicit/gather_forces.h.
#include "sim/elasticity/neo_hookean.glsl"

// The force of one tet on one of its corners [N].
vec3 neo_hookean_force(uint entry) {
    NeoHookeanTet tet = fetch_neo_hookean_tet(entry / 4u);
    vec3 g = shape_gradient(tet, entry % 4u);
    mat3 f = gradient_of(tet, texelFetch(positions, int(tet.nodes.x)).xyz, texelFetch(positions, int(tet.nodes.y)).xyz,
                         texelFetch(positions, int(tet.nodes.z)).xyz, texelFetch(positions, int(tet.nodes.w)).xyz);
    mat3 cofactors = cofactor(f);
    float squares = sum_of_squares(f);
    NeoHookeanStress stress = neo_hookean_stress(squares, dot(f[0], cofactors[0]), tet.mu, tet.lambda);
    vec3 traction = stress.shear * (f * g) + stress.pressure * (cofactors * g) - stress.opening * g;
#ifdef DAMPED
    vec4 v_0 = texelFetch(velocities, int(tet.nodes.x)), v_1 = texelFetch(velocities, int(tet.nodes.y));
    vec4 v_2 = texelFetch(velocities, int(tet.nodes.z)), v_3 = texelFetch(velocities, int(tet.nodes.w));
    mat3 rate = gradient_of(tet, v_0.xyz, v_1.xyz, v_2.xyz, v_3.xyz);
    float damping_time = 0.25 * (v_0.w + v_1.w + v_2.w + v_3.w);
    traction += damping_time * viscous_share(squares) * (f * (viscous_stress(f, rate, tet.mu, tet.lambda) * g));
#endif
    return -tet.volume * traction;
}

// Of all its tets on the node of a row of slices [N].
vec3 gather_tet_forces(uint row) {
    vec3 force = vec3(0.0);
    uint end = texelFetch(neo_hookean_starts, int(row / kSlice) + 1).x;
    for (uint e = texelFetch(neo_hookean_starts, int(row / kSlice)).x + row % kSlice; e < end; e += kSlice) {
        uint entry = texelFetch(neo_hookean_corners, int(e)).x;
        if (entry == kNone) break;
        force += neo_hookean_force(entry);
    }
    return force;
}
