// The faces that may touch others of their own object, in no particular order: those that are not calm, that is, as near
// to where the object's affine map puts them as half of what the map leaves of their clearance at rest.
// CPU twin: gelatin::cpu::SelfCollision. Parity: tests/gpu/self_collision_test.cpp.
#include "include/dispatches.glsl"
#include "include/global_index.glsl"
#include "layouts/rest_shape.glsl"
layout(local_size_x = 64) in;

layout(binding = 0) uniform samplerBuffer positions;     // xyz [m]
layout(binding = 1) uniform samplerBuffer rest_offsets;  // xyz [m]
layout(binding = 2) uniform usamplerBuffer faces;        // Face
layout(binding = 3) uniform samplerBuffer clearances;    // [m]
layout(std430, binding = 3) readonly buffer Fits { AffineFit fits[]; };
layout(std430, binding = 4) writeonly buffer Restless { uint restless[]; };
layout(std430, binding = 5) writeonly buffer Calm { uint is_calm[]; };
layout(std430, binding = 7) writeonly buffer ContactCounts { uint contact_counts[]; };
uniform uint face_count;

// How far from where the map puts it a node is, and no less for rounding [m].
float deviation(AffineFit fit, uint node) {
    vec3 rest = texelFetch(rest_offsets, int(node)).xyz;
    vec3 mapped = fit.column_x.xyz * rest.x + fit.column_y.xyz * rest.y + fit.column_z.xyz * rest.z;
    return distance(texelFetch(positions, int(node)).xyz - fit.center.xyz, mapped) + fit.column_y.w;
}

void main() {
    uint f = global_index();
    if (f >= face_count) return;
    uvec4 face = texelFetch(faces, int(f));
    AffineFit fit = fits[face.w];
    float limit = fit.column_x.w * texelFetch(clearances, int(f)).x;
    // What is not a number is not calm.
    bool calm = deviation(fit, face.x) < limit && deviation(fit, face.y) < limit && deviation(fit, face.z) < limit;
    is_calm[f] = calm ? 1u : 0u;
    contact_counts[f] = 0u;
    if (calm) return;
    restless[take_slot(kRestless, face_count)] = f;
}
