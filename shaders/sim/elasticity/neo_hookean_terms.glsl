// What neo-Hookean tets add to a node's part of the objective of a step of block descent. After sim/elasticity/node_terms.glsl,
// sim/descent/descent_step.glsl, and `positions`. DAMPED: some damping time is not zero. VOLUME: there is a volume term; after
// `tet_rests` and `offsets`.
// CPU twin: add_neo_hookean, add_viscosity, src/cpu/elasticity/neo_hookean.h.
#include "sim/elasticity/neo_hookean.glsl"

// The elastic energy as the corner with the shape gradient g sees it, and the tet's part of the volume term as
// add_tet_volume has it. @param bound its offset and modulus [Pa]
void add_neo_hookean(NeoHookeanTet tet, vec2 bound, vec3 g, mat3 f, inout NodeTerms terms) {
    mat3 cofactors = cofactor(f);
    float squares = sum_of_squares(f), over = 1.0 / (squares + 1.0), ratio = dot(f[0], cofactors[0]);
    NeoHookeanStress stress = neo_hookean_stress(squares, ratio, tet.mu, tet.lambda);
    float pressure = stress.pressure + bound.x + bound.y * ratio;
    vec3 stretched = f * g, slope = cofactors * g;
    terms.force -= tet.volume * (stress.shear * stretched + pressure * slope - stress.opening * g);
    terms.diagonal += tet.volume * stress.shear * dot(g, g);
    add_outer(tet.volume * 2.0 * tet.mu * over * over, stretched, terms);
    add_outer(tet.volume * (tet.lambda + bound.y), slope, terms);
}

// Its viscosity over a step that brings the gradient from `start` to f. `damping`: damping time over time step.
void add_viscosity(NeoHookeanTet tet, vec3 g, mat3 f, mat3 start, float damping, inout NodeTerms terms) {
    float scale = tet.volume * damping * viscous_share(sum_of_squares(start));
    float shear = 0.75 * tet.mu, dilation = tet.lambda - 0.625 * tet.mu;
    vec3 stress = viscous_stress(0.5 * (f + start), f - start, tet.mu, tet.lambda) * g;
    vec3 stretched = f * g;
    terms.force -= scale * (f * stress);
    for (int k = 0; k < 3; ++k) add_outer(scale * shear * dot(g, g), f[k], terms);
    add_outer(scale * (shear + dilation), stretched, terms);
    terms.diagonal += scale * max(dot(g, stress), 0.0);
}

void add_neo_hookean_corner(uint entry, uint first_tet, inout NodeTerms terms) {
    NeoHookeanTet tet = fetch_neo_hookean_tet(entry / 4u);
    vec3 g = shape_gradient(tet, entry % 4u);
    mat3 f = gradient_of(tet, texelFetch(positions, int(tet.nodes.x)).xyz, texelFetch(positions, int(tet.nodes.y)).xyz,
                         texelFetch(positions, int(tet.nodes.z)).xyz, texelFetch(positions, int(tet.nodes.w)).xyz);
#ifdef VOLUME
    int index = int(first_tet + entry / 4u);
    vec2 bound = vec2(texelFetch(offsets, index).x, texelFetch(tet_rests, index).z);
#else
    vec2 bound = vec2(0.0);
#endif
    add_neo_hookean(tet, bound, g, f, terms);
#ifdef DAMPED
    mat3 start = gradient_of(tet, texelFetch(start_positions, int(tet.nodes.x)).xyz,
                             texelFetch(start_positions, int(tet.nodes.y)).xyz,
                             texelFetch(start_positions, int(tet.nodes.z)).xyz,
                             texelFetch(start_positions, int(tet.nodes.w)).xyz);
    float damping_time = 0.25 * (texelFetch(start_velocities, int(tet.nodes.x)).w +
                                 texelFetch(start_velocities, int(tet.nodes.y)).w +
                                 texelFetch(start_velocities, int(tet.nodes.z)).w +
                                 texelFetch(start_velocities, int(tet.nodes.w)).w);
    add_viscosity(tet, g, f, start, damping_time / time_step, terms);
#endif
}

// Of all its tets to the node of a row of slices. @param first_tet as DescentRow has it
void add_neo_hookean_tets(uint row, uint first_tet, inout NodeTerms terms) {
    uint end = texelFetch(neo_hookean_starts, int(row / kSlice) + 1).x;
    for (uint e = texelFetch(neo_hookean_starts, int(row / kSlice)).x + row % kSlice; e < end; e += kSlice) {
        uint entry = texelFetch(neo_hookean_corners, int(e)).x;
        if (entry == kNone) break;
        add_neo_hookean_corner(entry, first_tet, terms);
    }
}
