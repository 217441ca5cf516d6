// Arguments of the dispatches of large islands' rounds of conjugate gradients: none has work groups until an island needs it.
#include "sim/collision/make_dispatch.glsl"

uniform uint next_round;      // where what follows has its arguments: of a round its islands, its chunks,
uniform uint next_iteration;  // and an iteration's chunks
layout(std430) writeonly buffer Rounds { Dispatch rounds[]; };

// All who open one write the same.
void open_round() {
    rounds[next_round] = make_dispatch(object_count, object_count);
    rounds[next_round + 1u] = make_dispatch(chunk_count, chunk_count);
}
void open_iteration() { rounds[next_iteration] = make_dispatch(chunk_count, chunk_count); }
