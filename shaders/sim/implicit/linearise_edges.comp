// The stiffness of springs and tets by edge, one invocation an edge. Springs have no part that is negative where they are
// compressed, and a damper over the part makes of a spring another one (cpu::damped_spring). Of neo-Hookean tets the derivative of
// the cofactors is limited to what shear outweighs.
// CPU twin: gelatin::cpu::ElasticSystem. Parity: tests/gpu/implicit/elastic_system_test.cpp.
#include "include/global_index.glsl"
#include "layouts/element_edge.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/tets.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer edge_tets;        // 16 t + 4 c + e, in slices of 64 edges; kNone pads
uniform usamplerBuffer edge_tet_starts;  // of the slices
uniform samplerBuffer tet_rows;          // four a tet
layout(std430) readonly buffer Edges { ElementEdge edges[]; };
layout(std430) writeonly buffer Matrices { EdgeMatrix matrices[]; };
uniform samplerBuffer damping_times;  // of nodes [s]
uniform uint edge_count;

#ifdef NEO_HOOKEAN
// The largest singular value is at most this: the root of the largest sum of a row of F^T F (Gershgorin).
float largest_stretch(mat3 f) {
    mat3 square = transpose(f) * f;
    float most = 0.0;
    for (int i = 0; i < 3; ++i) most = max(most, abs(square[i].x) + abs(square[i].y) + abs(square[i].z));
    return sqrt(most);
}

// v -> axis x v
mat3 crossing(vec3 axis) { return mat3(0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0); }

// What the force on corner c changes by as corner e moves, reversed.
mat3 neo_hookean_matrix(uint number, uvec4 tet, vec4 rest, uint c, uint e) {
    NeoHookeanTet t = fetch_neo_hookean(number, tet);
    mat3 f = t.gradient;
    vec3 g = t.gradients[c], h = t.gradients[e];
    vec3 stretched = f * g, other_stretched = f * h;
    float over = 1.0 / (t.squares + 1.0), along = 2.0 * t.mu * over * over;
    mat3 diagonal = mat3(t.shear);
    float damping_time = 0.0;
    for (int k = 0; k < 4; ++k) damping_time += 0.25 * texelFetch(damping_times, int(tet[k])).x;
    float viscosity = damping_time / clock[0].step * 4.0 * over, damped_shear = viscosity * 0.75 * t.mu;
    along += viscosity * (t.lambda - 0.625 * t.mu);
    for (int k = 0; k < 3; ++k) diagonal += damped_shear * outerProduct(f[k], f[k]);
    float most = t.shear / max(largest_stretch(f), 1e-6), turn = clamp(t.pressure, -most, most);
    return dot(g, h) * diagonal + outerProduct(along * stretched, other_stretched) +
           outerProduct(damped_shear * other_stretched, stretched) +
           outerProduct((t.lambda + rest.x * rest.z) * (t.cofactors * g), t.cofactors * h) +
           crossing(turn * (f * cross(h, g)));
}
#endif

void main() {
    uint index = global_index();
    if (index >= edge_count) return;
    ElementEdge edge = edges[index];
    vec3 apart = texelFetch(positions, int(edge.upper)).xyz - texelFetch(positions, int(edge.lower)).xyz;
    float inverse_length = inversesqrt(max(dot(apart, apart), 1e-30));
    float damping = 0.5 / clock[0].step *
                    (texelFetch(damping_times, int(edge.lower)).x + texelFetch(damping_times, int(edge.upper)).x);
    float rest_length = (edge.rest_length + damping / inverse_length) / (1.0 + damping);
    float stiffness = edge.stiffness * (1.0 + damping);
    float pull = stiffness - stiffness * rest_length * inverse_length, across = max(pull, 0.0);
    vec3 direction = inverse_length * apart;
    mat3 sum = mat3(across) + outerProduct((stiffness - across) * direction, direction);

    uint end = texelFetch(edge_tet_starts, int(index / kSlice) + 1).x;
    for (uint k = texelFetch(edge_tet_starts, int(index / kSlice)).x + index % kSlice; k < end; k += kSlice) {
        uint entry = texelFetch(edge_tets, int(k)).x;
        if (entry == kNone) break;
        uint t = entry / 16u, c = entry / 4u % 4u, e = entry % 4u;
#ifdef NEO_HOOKEAN
        uint number = texelFetch(neo_hookean_numbers, int(t)).x;
        if (number != kNone) {
            sum -= neo_hookean_matrix(number, texelFetch(tets, int(t)), texelFetch(tet_rests, int(t)), c, e);
            continue;
        }
#endif
        sum -= outerProduct(texelFetch(tet_rows, int(4u * t + c)).xyz, texelFetch(tet_rows, int(4u * t + e)).xyz);
    }
    vec3 force = pull * apart;
    matrices[index] = EdgeMatrix(vec4(sum[0], force.x), vec4(sum[1], force.y), vec4(sum[2], force.z));
}
