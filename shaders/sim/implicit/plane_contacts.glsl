// Nodes near colliders. CPU twin: gelatin::cpu::ContactRows.
#include "sim/collision/colliders.glsl"
#include "sim/implicit/group_sums.glsl"

uniform samplerBuffer positions;    // xyz [m]
uniform samplerBuffer predicted;    // displacements [m]; w: 1 / h of contacts, 0 of held nodes [m/N]
uniform samplerBuffer thicknesses;  // of objects [m]
uniform uint body_count;
uniform uint body_nodes;            // of all bodies
layout(std430) readonly buffer PlaneMemories { PlaneMemory plane_memories[]; };  // by collider, and by node

// The reach that a contact had, as far as the gap allows more [m].
float known_reach(PlaneMemory memory, float thickness, float gap) { return max(memory.reach, min(thickness, gap)); }
