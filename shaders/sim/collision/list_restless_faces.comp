// The faces that may touch others of their own object, in no particular order: those that are farther from where the object's
// affine map places them than half of their clearance at rest after the map. One work group for each chunk of a restless
// object's faces. CPU twin: gelatin::cpu::FindSelfCollisions. Parity: tests/gpu/collision/find_self_collisions_test.cpp.
#define WRITES_DISPATCHES
#include "sim/collision/affine_fit.glsl"
#include "sim/collision/dispatches.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer chunks;     // Chunk
uniform samplerBuffer clearances;  // [m]
uniform usamplerBuffer faces;      // Face
layout(std430) readonly buffer RestlessFaceChunks { uint restless_chunks[]; };
layout(std430) writeonly buffer RestlessFaces { uint restless[]; };
layout(std430) writeonly buffer Calm { uint is_calm[]; };
layout(std430) writeonly buffer ContactCounts { uint contact_counts[]; };
uniform uint face_count;

void main() {
    uvec4 chunk = texelFetch(chunks, int(restless_chunks[gl_WorkGroupID.x]));
    AffineFit fit = fetch_fit(chunk.x);
    for (uint k = gl_LocalInvocationID.x; k < chunk.z; k += 64u) {
        uint f = chunk.y + k;
        uvec4 face = texelFetch(faces, int(f));
        float limit = fit.column_x.w * texelFetch(clearances, int(f)).x;
        bool calm = true;  // what is not a number is not
        for (int corner = 0; corner < 3; ++corner) {
            uint node = face[corner];
            calm = calm && deviation(fit, node, position(node) - fit.center.xyz) + fit.column_y.w < limit;
        }
        is_calm[f] = calm ? 1u : 0u;
        contact_counts[f] = 0u;
        if (!calm) restless[take_slot(kRestless, face_count)] = f;
    }
}
