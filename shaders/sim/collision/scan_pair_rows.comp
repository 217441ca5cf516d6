// The offsets of each object's row of pairs, and of its words and entries: prefix sums over the objects by one work group. Rows
// beyond the end of a buffer are omitted and counted as losses.
#define WRITES_PAIR_ROWS
#define WRITES_DISPATCHES
#include "sim/collision/pairs.glsl"
layout(local_size_x = 256) in;

uniform uint object_count;
uniform uint node_count;
uniform uint pair_capacity;
uniform uint word_capacity;

shared uvec3 parts[256];
shared uint kept_pairs, kept_entries;

// Pairs, words and entries of a row. Sums are clamped to the largest number, which no buffer can hold.
uvec3 size_of_row(uint object) {
    uint pairs = pair_rows[object].pair_count;
    return pairs * uvec3(1u, word_count(object), leaf_count(object));
}
uvec3 add(uvec3 a, uvec3 b) { return a + min(b, ~a); }

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (lane == 0u) {
        kept_pairs = 0u;
        kept_entries = 0u;
    }
    uint share = (object_count + 255u) / 256u;
    uint first = min(lane * share, object_count);
    uint last = min(first + share, object_count);
    uvec3 sum = uvec3(0u);
    for (uint object = first; object < last; ++object) sum = add(sum, size_of_row(object));
    parts[lane] = sum;
    barrier();

    uvec3 at = uvec3(0u);
    for (uint l = 0u; l < lane; ++l) at = add(at, parts[l]);
    for (uint object = first; object < last; ++object) {
        uint pairs = pair_rows[object].pair_count;
        uvec3 end = add(at, size_of_row(object));
        bool fits = end.x <= pair_capacity && end.y <= word_capacity && end.z < 0xFFFFFFFFu;
        if (!fits) atomicAdd(dispatches[kLosses].count, pairs);
        if (fits) atomicMax(kept_pairs, end.x);
        if (fits) atomicMax(kept_entries, end.z);
        pair_rows[object] = PairRow(at.x, fits ? pairs : 0u, at.y, at.z);
        at = end;
    }
    barrier();
    if (lane != 0u) return;
    dispatches[kEntries] = dispatch_invocations(kept_entries);
    dispatches[kFacePairs] = Dispatch(0u, 1u, 1u, 0u);
    dispatches[kPairs] = dispatch_invocations(kept_pairs);
    dispatches[kPairGroups] = make_dispatch(kept_pairs, kept_pairs);
    dispatches[kNodes] = dispatch_invocations(kept_pairs > 0u ? node_count : 0u);
    dispatches[kScan] = Dispatch(min(kept_pairs, 1u), 1u, 1u, kept_pairs);
    dispatches[kTests] = Dispatch(0u, 1u, 1u, 0u);
}
