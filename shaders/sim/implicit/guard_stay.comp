// Nothing moves in a part for which the guard of pairs has found no other way.
// CPU twin: gelatin::cpu::ImplicitStep::guard. Parity: tests/gpu/implicit/pair_guard_test.cpp.
#include "sim/implicit/guarded_pairs.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer EndPositions { vec4 end_positions[]; };

void main() {
    uint n = global_index();
    if (n < node_count) end_positions[n] = texelFetch(positions, int(n));
}
