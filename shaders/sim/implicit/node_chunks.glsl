// Chunks of nodes, a work group each, for kernels of a try.
#include "include/global_index.glsl"
#include "sim/implicit/clock.glsl"

uniform usamplerBuffer chunks;        // object, first, count, origin
uniform usamplerBuffer chunk_starts;  // of each object, and the end
uniform uint chunk_count;
