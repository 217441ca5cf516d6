// Forces of neo-Hookean tets for explicit solvers, at `positions` with `velocities`, buffer textures that must be declared
// before. DAMPED: some damping time is not zero. CPU twin: cpu::gather_tet_forces, src/cpu/explicit/gather_forces.h.
#include "sim/elasticity/neo_hookean.glsl"

// The force of one tet on one of its corners [N].
vec3 neo_hookean_force(uint corner, NeoHookeanCorner tet, vec3 position, vec4 velocity) {
    vec3 a = texelFetch(positions, int(tet.node_a)).xyz - position;
    vec3 b = texelFetch(positions, int(tet.node_b)).xyz - position;
    vec3 c = texelFetch(positions, int(tet.node_c)).xyz - position;
    TetAtCorner at = tet_at_corner(tet, a, b, c);
    NeoHookeanStress stress = neo_hookean_stress(tet, at);
    vec3 force = opening_force(corner, at.squares) - stress.shear * at.stretched - stress.pressure * at.slope;
#ifdef DAMPED
    vec4 v_a = texelFetch(velocities, int(tet.node_a)), v_b = texelFetch(velocities, int(tet.node_b));
    vec4 v_c = texelFetch(velocities, int(tet.node_c));
    mat3 f = gradient_of(tet, a, b, c);
    mat3 rate = gradient_of(tet, v_a.xyz - velocity.xyz, v_b.xyz - velocity.xyz, v_c.xyz - velocity.xyz);
    float damping_time = 0.25 * (velocity.w + v_a.w + v_b.w + v_c.w);
    force -= damping_time * viscous_share(at.squares) * (f * viscous_traction(tet, f, rate, shape_gradient(tet)));
#endif
    return force;
}

// The force of all its tets on the node of a row of slices [N].
vec3 gather_tet_forces(uint row, vec3 position, vec4 velocity) {
    vec3 force = vec3(0.0);
    uint end = texelFetch(neo_hookean_starts, int(row / kSlice) + 1).x;
    for (uint e = texelFetch(neo_hookean_starts, int(row / kSlice)).x + row % kSlice; e < end; e += kSlice) {
        NeoHookeanCorner tet = fetch_neo_hookean_corner(e);
        if (tet.tet == kNone) break;
        force += neo_hookean_force(e, tet, position, velocity);
    }
    return force;
}
