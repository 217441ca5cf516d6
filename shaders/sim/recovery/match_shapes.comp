// Where the shape at rest of an object that has lost it comes nearest to its nodes, and how it moves from there with
// their momentum and angular momentum (shape matching, Mueller et al. 2005). Without OBJECTS: sums over a chunk's nodes,
// one work group a chunk; with it: the place, one invocation an object.
// CPU twin: gelatin::cpu::ShapeMatcher. Parity: tests/gpu/recovery/match_shapes_test.cpp.
#include "layouts/thresholds.glsl"
#include "include/global_index.glsl"
#include "layouts/chunk.glsl"
#include "sim/recovery/inverted_tets.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;      // xyz [m]
uniform samplerBuffer velocities;     // xyz [m/s]
uniform usamplerBuffer chunk_starts;  // of each object, and the end
uniform samplerBuffer rest_offsets;   // from the centre of mass [m], mass [kg]
layout(std430) readonly buffer Chunks { Chunk chunks[]; };
layout(std430) buffer Sums { ShapeSums shape_sums[]; };
layout(std430) writeonly buffer Places { ShapePlace places[]; };
uniform uint element_count;

ShapeSums add(ShapeSums a, ShapeSums b) {
    return ShapeSums(a.column_x + b.column_x, a.column_y + b.column_y, a.column_z + b.column_z,
                     a.momentum + b.momentum, a.spin + b.spin);
}

const ShapeSums kNothing = ShapeSums(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));

bool may_be_lost(uint object) { return inverted[object] > most_inverted(object); }

#ifdef OBJECTS
#include "sim/recovery/nearest_rotation.glsl"

layout(std430) buffer LostFor { float lost_for[]; };  // how long objects have seemed to be lost [s]
uniform float elapsed;                                // since the last call [s]

float trace(mat3 m) { return m[0][0] + m[1][1] + m[2][2]; }

void main() {
    uint object = global_index();
    if (object >= element_count) return;
    places[object].center.w = 0.0;
    float before = lost_for[object];
    lost_for[object] = 0.0;
    if (!may_be_lost(object)) return;
    uint first = texelFetch(chunk_starts, int(object)).x, end = texelFetch(chunk_starts, int(object) + 1).x;
    ShapeSums sums = kNothing;
    for (uint c = first; c < end; ++c) sums = add(sums, shape_sums[c]);

    RestMoment rest = rest_moments[object];
    float mass = rest.inverse_x.w;
    mat3 inverse_ = mat3(rest.inverse_x.xyz, rest.inverse_y.xyz, rest.inverse_z.xyz);
    mat3 moment = mat3(sums.column_x.xyz, sums.column_y.xyz, sums.column_z.xyz);
    vec3 center = vec3(sums.column_x.w, sums.column_y.w, sums.column_z.w) / mass;
    float square = sums.momentum.w - mass * dot(center, center);
    mat3 affine = moment * inverse_, squares = transpose(affine) * affine;
    float sum = trace(squares), products = 0.5 * (sum * sum - trace(squares * squares));
    if (products > kThinnest * sum * sum && trace(affine * transpose(moment)) > kLeastExplained * square) return;
    lost_for[object] = before + elapsed;
    if (!(before + elapsed > kPatience)) return;

    // Moments of inertia in units of the object's own: determinants have three of them.
    float unit = trace(inverse_);
    mat3 rotation = nearest_rotation(moment), square_at_rest = inverse(inverse_ / unit);
    mat3 inertia = trace(square_at_rest) * mat3(1.0) - square_at_rest;
    vec3 spin = sums.spin.xyz - cross(center, sums.momentum.xyz);
    spin = rotation * (inverse(inertia) * (transpose(rotation) * (unit * spin)));
    vec3 origin = texelFetch(positions, int(chunks[first].origin)).xyz;
    places[object] = ShapePlace(vec4(origin + center, 1.0), vec4(rotation[0], 0.0), vec4(rotation[1], 0.0),
                                vec4(rotation[2], 0.0), vec4(sums.momentum.xyz / mass, 0.0), vec4(spin, 0.0));
}
#else
shared ShapeSums parts[64];

void main() {
    uint c = group_index();
    if (c >= element_count) return;
    Chunk chunk = chunks[c];
    if (!may_be_lost(chunk.object)) return;
    vec3 origin = texelFetch(positions, int(chunk.origin)).xyz;
    uint lane = gl_LocalInvocationID.x;
    ShapeSums sums = kNothing;
    for (uint k = lane; k < chunk.count; k += 64u) {
        int n = int(chunk.first + k);
        vec4 rest = texelFetch(rest_offsets, n);
        vec3 x = texelFetch(positions, n).xyz - origin, v = texelFetch(velocities, n).xyz;
        vec3 mx = rest.w * x;
        sums = add(sums, ShapeSums(vec4(mx * rest.x, mx.x), vec4(mx * rest.y, mx.y), vec4(mx * rest.z, mx.z),
                                   vec4(rest.w * v, dot(mx, x)), vec4(cross(mx, v), 0.0)));
    }
    parts[lane] = sums;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) sums = add(sums, parts[l]);
    shape_sums[c] = sums;
}
#endif
