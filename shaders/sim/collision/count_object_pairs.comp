// The number of objects that each object may touch: those whose boxes meet, or all. OBJECT_TREE: found in a tree. CPU twin:
// gelatin::cpu::Collision. Parity: tests/gpu/collision/collision_test.cpp.
#define WRITES_PAIR_ROWS
#include "sim/collision/object_may_touch.glsl"
layout(local_size_x = 64) in;

void main() {
    uint a = global_index();
    if (a >= object_count) return;
    uint count = 0u;
    Search search = start_search(a);
    while (next_partner(search) != kNone) ++count;
    pair_rows[a].pair_count = count;
}
