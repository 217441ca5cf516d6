// The system of a step as conjugate gradients see it: chunks of nodes, a work group of 64 each. Bodies without contacts are islands,
// and each is solved by itself.
#include "include/global_index.glsl"
#include "layouts/step_system.glsl"

uniform usamplerBuffer chunks;  // object, first, count, origin
uniform samplerBuffer loads;    // m / h^2 (y - x) + f [N]; w: m / h^2 [N/m], 0 where a node is held
uniform uint chunk_count;
uniform usamplerBuffer chunk_starts;  // of each object, and the end
uniform uint object_count;
uniform uint turn;              // of the two states of each object, the one before this iteration

uint state_before(uint object) { return turn * object_count + object; }
uint state_after(uint object) { return (1u - turn) * object_count + object; }
