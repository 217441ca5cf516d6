// The contribution of neo-Hookean tets to a node's part of the objective of a step of block descent. To be included after
// sim/elasticity/node_terms.glsl, sim/descent/descent_step.glsl, and `positions`. DAMPED: some damping time is not zero.
// VOLUME: there is a volume term; after `offsets`. CPU twin: add_neo_hookean, add_viscosity,
// src/cpu/elasticity/neo_hookean.inl.
#include "sim/elasticity/tet_walk.glsl"

// The elastic energy as a function of the corner, and the tet's part of the volume term as in add_tet_volume.
// @param bound its offset and modulus, times the volume at rest [J]
void add_neo_hookean(NeoHookeanStep tet, TetAtCorner at, vec2 bound, inout NodeTerms terms) {
    NeoHookeanStress stress = neo_hookean_stress(tet, at);
    float pressure = stress.pressure + bound.x + bound.y * at.ratio, over = 1.0 / (at.squares + 1.0);
    vec3 g = shape_gradient(tet);
    terms.force -= stress.shear * at.stretched + pressure * at.slope;
    terms.diagonal += stress.shear * dot(g, g);
    add_outer(2.0 * tet.mu * over * over, at.stretched, terms);
    add_outer(tet.lambda + bound.y, at.slope, terms);
}

// Its viscosity over a step that changes the gradient from `start` to f. `damping`: damping time divided by time step.
void add_viscosity(NeoHookeanStep tet, mat3 f, mat3 start, float damping, inout NodeTerms terms) {
    vec3 g = shape_gradient(tet);
    float scale = damping * viscous_share(sum_of_squares(start)), shear = 0.75 * tet.mu;
    vec3 traction = viscous_traction(tet, 0.5 * (f + start), f - start, g);
    terms.force -= scale * (f * traction);
    for (int k = 0; k < 3; ++k) add_outer(scale * shear * dot(g, g), f[k], terms);
    add_outer(scale * (0.125 * tet.mu + tet.lambda), f * g, terms);
    terms.diagonal += scale * max(dot(g, traction), 0.0);
}

// The contribution of all its tets to node `n`, which row `row` of slices has.
void add_neo_hookean_tets(uint row, uint n, vec3 position, inout NodeTerms terms) {
    vec4 start = texelFetch(start_positions, int(n));
    Strip before = kNoStrip;
    vec3 damping_times = vec3(0.0);
    TetWalk walk = begin_tet_walk(row);
    while (walk_on(position, walk)) {
        NeoHookeanStep tet = walk.tet;
#ifdef DAMPED
        vec4 other = texelFetch(start_positions, walk.node);
        step_strip(tet.vertex, other.xyz - start.xyz, before);
        step_numbers(tet.vertex, other.w, damping_times);
#endif
        if (tet.tet == kNone) continue;
        TetAtCorner at = tet_at_corner(tet, walk.strip);
#ifdef VOLUME
        vec2 bound = vec2(texelFetch(offsets, int(tet.tet)).x, tet.modulus);
#else
        vec2 bound = vec2(0.0);
#endif
        add_neo_hookean(tet, at, bound, terms);
        terms.force += opening_force(walk.step, at.squares);
#ifdef DAMPED
        float damping_time = 0.25 * (start.w + sum_of(damping_times));
        add_viscosity(tet, gradient_of(tet, walk.strip), gradient_of(tet, before), damping_time / time_step, terms);
#endif
    }
}
