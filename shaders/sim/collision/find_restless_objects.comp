// The objects that may have restless faces: some node is farther from where the object's affine map places it than half of the
// smallest clearance after the map. Any map is valid, so the last one is used, displaced with the object; a new one is made for
// the objects that it does not explain. One work group for each chunk of nodes. CPU twin: gelatin::cpu::FindSelfCollisions. Parity:
// tests/gpu/collision/find_self_collisions_test.cpp.
#define WRITES_DISPATCHES
#include "sim/collision/affine_fit.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/collision/rounding.glsl"
#include "include/global_index.glsl"
layout(local_size_x = 32) in;  // what every lane reads of the object outweighs a node: few lanes, longer loops

uniform usamplerBuffer chunks;  // Chunk, of nodes
layout(std430) writeonly buffer LastRestless { uint last_restless[]; };  // step, by object
uniform uint chunk_count;
uniform uint step_number;


void main() {
    uint group = group_index(), lane = gl_LocalInvocationID.x;
    if (group == 0u && lane == 0u) {
        for (uint work = kRestless; work <= kRestlessChunks; ++work) dispatches[work] = Dispatch(0u, 1u, 1u, 0u);
    }
    if (group >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(group));
    AffineFit fit = fetch_fit(chunk.x);
    vec3 center = fit.center.xyz + (position(chunk.w) - fit.origin.xyz);
    bool calm = true;  // what is not a number is not
    for (uint k = lane; k < chunk.z; k += 32u) {
        vec3 x = position(chunk.y + k);
        float rounding = 32.0 * kEpsilon * (abs(x.x) + abs(x.y) + abs(x.z) + fit.center.w);
        calm = calm && deviation(fit, chunk.y + k, x - center) + rounding < fit.column_z.w;
    }
    if (!calm) last_restless[chunk.x] = step_number;
}
