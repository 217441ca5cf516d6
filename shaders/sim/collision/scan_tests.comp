// The number of tests before each pair: prefix sums over the pairs by one work group.
#define WRITES_OBJECT_PAIRS
#define WRITES_DISPATCHES
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_tests.glsl"
layout(local_size_x = 256) in;

shared uint parts[256];

uint add(uint a, uint b) { return a + min(b, ~a); }

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint pair_count = dispatches[kScan].count;
    uint share = (pair_count + 255u) / 256u;
    uint first = min(lane * share, pair_count);
    uint last = min(first + share, pair_count);
    uint sum = 0u;
    for (uint p = first; p < last; ++p) sum = add(sum, count_tests(object_pairs[p]));
    parts[lane] = sum;
    barrier();

    uint at = 0u;
    for (uint l = 0u; l < lane; ++l) at = add(at, parts[l]);
    for (uint p = first; p < last; ++p) {
        object_pairs[p].first_test = at;
        at = add(at, count_tests(object_pairs[p]));
    }
    if (lane != 255u) return;
    if (at == kNone) atomicAdd(dispatches[kLosses].count, 1u);
    dispatches[kTests] = dispatch_invocations(at);
}
