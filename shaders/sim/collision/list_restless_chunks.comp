// The chunks of nodes and of faces of restless objects, and these objects, in no particular order. An object that was restless
// in the previous step is listed once more, which clears the results of its faces.
#define WRITES_DISPATCHES
#include "sim/collision/dispatches.glsl"
#include "include/global_index.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer chunks;  // Chunk, of nodes and then of faces
layout(std430) readonly buffer LastRestless { uint last_restless[]; };  // step, by object
layout(std430) writeonly buffer RestlessNodeChunks { uint restless_node_chunks[]; };
layout(std430) writeonly buffer RestlessFaceChunks { uint restless_face_chunks[]; };
layout(std430) writeonly buffer RestlessObjects { uint restless_objects[]; };
uniform uint node_chunk_count;
uniform uint chunk_count;
uniform uint object_count;
uniform uint step_number;

void main() {
    uint c = global_index();
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    if (step_number - last_restless[chunk.x] > 1u) return;
    if (c >= node_chunk_count) {
        restless_face_chunks[atomicAdd(dispatches[kRestlessChunks].groups_x, 1u)] = c;
        return;
    }
    restless_node_chunks[atomicAdd(dispatches[kFitSums].groups_x, 1u)] = c;
    bool is_first = chunk.y == chunk.w;  // it starts with the object's first node
    if (is_first) restless_objects[take_slot(kFits, object_count)] = chunk.x;
}
