// Forces of neo-Hookean tets for explicit solvers, at `positions` with `velocities`, buffer textures that must be declared
// before. DAMPED: some damping time is not zero. VOLUME: there is a volume term, which is added for nodes of such tets.
// CPU twin: cpu::gather_tet_forces, src/cpu/explicit/gather_forces.h.
#include "sim/elasticity/tet_walk.glsl"
#include "sim/elasticity/volume_stresses.glsl"

bool has_neo_hookean_tets(uint row) {
    uint first = texelFetch(neo_hookean_starts, int(row / kSlice)).x + row % kSlice;
    uint end = texelFetch(neo_hookean_starts, int(row / kSlice) + 1).x;
    return first < end && texelFetch(neo_hookean_strips, int(4u * first)).x != kNone;
}

// The force of all its tets on the node of a row of slices [N].
vec3 gather_tet_forces(uint row, vec3 position, vec4 velocity) {
    vec3 force = vec3(0.0);
    Strip rates = kNoStrip;
    vec3 damping_times = vec3(0.0);
#ifdef VOLUME
    float own = texelFetch(volume_stresses, int(row)).x;
    vec3 stresses = vec3(0.0);
#endif
    TetWalk walk = begin_tet_walk(row);
    while (walk_on(position, walk)) {
        NeoHookeanStep tet = walk.tet;
#ifdef DAMPED
        vec4 other = texelFetch(velocities, walk.node);
        step_strip(tet.vertex, other.xyz - velocity.xyz, rates);
        step_numbers(tet.vertex, other.w, damping_times);
#endif
#ifdef VOLUME
        step_numbers(tet.vertex, texelFetch(volume_stresses, walk.node).x, stresses);
#endif
        if (tet.tet == kNone) continue;
        TetAtCorner at = tet_at_corner(tet, walk.strip);
        NeoHookeanStress stress = neo_hookean_stress(tet, at);
#ifdef VOLUME
        stress.pressure += 0.25 * (own + sum_of(stresses)) * tet.volume;
#endif
        force += opening_force(walk.step, at.squares) - stress.shear * at.stretched - stress.pressure * at.slope;
#ifdef DAMPED
        mat3 f = gradient_of(tet, walk.strip), rate = gradient_of(tet, rates);
        float damping_time = 0.25 * (velocity.w + sum_of(damping_times));
        force -= damping_time * viscous_share(at.squares) * (f * viscous_traction(tet, f, rate, shape_gradient(tet)));
#endif
    }
    return force;
}
