// The system of a step as conjugate gradients see it: chunks of nodes, a work group of 64 each.
#include "include/global_index.glsl"
#include "layouts/step_system.glsl"

uniform usamplerBuffer chunks;  // object, first, count, origin
uniform samplerBuffer loads;    // m / h^2 (y - x) + f [N]; w: m / h^2 [N/m], 0 where a node is held
uniform uint chunk_count;
uniform uint turn;              // of the two states, the one before this iteration
