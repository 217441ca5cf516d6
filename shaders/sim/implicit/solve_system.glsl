// The system of a step as conjugate gradients see it: chunks of nodes, a work group of 64 each; bodies with rows in common are an
// island, and each island is solved by itself. Tables: gpu::RowTables.
#include "include/global_index.glsl"
#include "layouts/packing.glsl"
#include "layouts/step_rows.glsl"
#include "layouts/step_system.glsl"

uniform usamplerBuffer chunks;  // object, first, count, origin
uniform usamplerBuffer chunk_starts;      // of each object, and the end
uniform usamplerBuffer islands;           // StepIsland, three texels each
uniform usamplerBuffer island_of_object;  // kNone: it is not solved
uniform usamplerBuffer island_bodies;     // objects
uniform usamplerBuffer island_chunks;     // of nodes
uniform samplerBuffer positions;          // xyz [m]
uniform samplerBuffer loads;    // m / h^2 (y - x) + f [N]; w: m / h^2 [N/m], 0 where a node is held
uniform samplerBuffer bodies;             // StepBody, five texels each
uniform samplerBuffer inverses;           // BodyInverse, nine texels each
uniform uint chunk_count;
uniform uint object_count;
uniform uint small_chunks;      // an island of so many chunks at most is small: solve_islands.comp solves it
uniform uint turn;              // of the two states of each island, the one before this iteration

uint state_before(uint island) { return turn * object_count + island; }
uint state_after(uint island) { return (1u - turn) * object_count + island; }

StepIsland fetch_island(uint number) {
    uvec4 a = texelFetch(islands, 3 * int(number)), b = texelFetch(islands, 3 * int(number) + 1),
          c = texelFetch(islands, 3 * int(number) + 2);
    return StepIsland(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, c.x, c.y, 0u, 0u);
}

bool has_rows(StepIsland island) { return island.first_row < island.row_end; }

// Not one without bodies.
bool is_small(StepIsland island) { return island.chunk_end - island.first_chunk - 1u < small_chunks; }

// kNone: none, or it is small.
uint large_island_of(uint object) {
    uint number = texelFetch(island_of_object, int(object)).x;
    return number == kNone || is_small(fetch_island(number)) ? kNone : number;
}

vec3 center_of(uint object) { return texelFetch(bodies, 5 * int(object)).xyz; }

float enough_of(uint object) { return texelFetch(bodies, 5 * int(object) + 1).w; }

vec3 at_node(BodyMotion motion, vec3 center, uint n) {
    return motion.displacement.xyz + cross(motion.rotation.xyz, texelFetch(positions, int(n)).xyz - center);
}

float dot_of(BodyMotion a, BodyMotion b) {
    return dot(a.displacement.xyz, b.displacement.xyz) + dot(a.rotation.xyz, b.rotation.xyz);
}

BodyInverse fetch_inverse(uint object) {
    vec4 columns[9];
    for (int k = 0; k < 9; ++k) columns[k] = texelFetch(inverses, 9 * int(object) + k);
    return BodyInverse(columns[0], columns[1], columns[2], columns[3], columns[4], columns[5], columns[6], columns[7], columns[8]);
}

// E_b^-1 f
BodyMotion times(BodyInverse i, BodyMotion force) {
    vec3 f = force.displacement.xyz;
    mat3 x = mat3(i.b_x.xyz, i.b_y.xyz, i.b_z.xyz);
    vec3 rotation = mat3(i.c_x.xyz, i.c_y.xyz, i.c_z.xyz) * (force.rotation.xyz - f * x);
    return BodyMotion(vec4(mat3(i.a_x.xyz, i.a_y.xyz, i.a_z.xyz) * f - x * rotation, 0.0), vec4(rotation, 0.0));
}
