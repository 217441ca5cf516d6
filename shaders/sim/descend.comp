// Vertex block descent (Chen et al. 2024): each node of one colour makes a Newton step on its own part of the objective.
// One invocation a row; rows are nodes by colour, in slices of 64 as advance_nodes has them. Neighbours have other
// colours, so that what is gathered is not written here.
// CPU twin: gelatin::cpu::BlockDescent. Parity: tests/gpu/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "include/colliders.glsl"
#include "include/descent_step.glsl"
#include "include/node_terms.glsl"
layout(local_size_x = 64) in;

layout(binding = 0) uniform samplerBuffer positions;      // xyz [m], inverse mass [1/kg]
layout(binding = 3) uniform usamplerBuffer rows;          // node, object; node 0xFFFFFFFF pads a colour
layout(binding = 4) uniform usamplerBuffer half_springs;  // HalfSpringPair
layout(binding = 5) uniform samplerBuffer stiffnesses;    // of the pair [N/m]
layout(binding = 6) uniform usamplerBuffer slice_starts;
layout(binding = 8) uniform usamplerBuffer tet_corners;   // TetCorner
layout(binding = 9) uniform usamplerBuffer corner_starts;
layout(binding = 10) uniform samplerBuffer tet_rests;     // volume [m^3], modulus [Pa]
layout(std430, binding = 0) writeonly buffer OutPositions { vec4 out_positions[]; };
layout(std430, binding = 1) buffer NearFlat { uint near_flat[]; };  // an invocation reads and clears its own node's
layout(std430, binding = 2) writeonly buffer Touches { uint object_touches[]; };
#ifdef NEO_HOOKEAN
#include "include/neo_hookean_terms.glsl"
#endif
uniform uint first_row;
uniform uint row_count;
uniform uint clear_marks;  // before they are made anew

vec3 position_of(uint node) { return texelFetch(positions, int(node)).xyz; }
vec3 start_of(uint node) { return texelFetch(start_positions, int(node)).xyz; }

void add_half_spring(vec4 position, vec3 way, float damping_time, vec3 if_coincident, uint other, float rest_length,
                     float stiffness, inout NodeTerms terms) {
    vec3 other_position = position_of(other);
#ifdef DAMPED
    vec3 ahead = other_position - start_of(other) - way;
    float damping = 0.5 * (damping_time + texelFetch(start_velocities, int(other)).w) / time_step;
#else
    vec3 ahead = vec3(0.0);
    float damping = 0.0;
#endif
    add_spring(other_position - position.xyz, ahead, if_coincident, rest_length, stiffness, damping, terms);
}

// Pushed out of a collider it slides by Coulomb's law: what it is pushed by is the normal force over the node's own
// stiffness, and so is the way that friction takes back.
void push_out(uint c, vec4 surface, vec3 start, inout vec3 position, inout bool touches) {
    if (surface.w >= 0.0) return;
    float friction = texelFetch(colliders, int(4u * c + 3u)).y;
    position -= surface.w * surface.xyz;
    vec3 way = position - start;
    vec3 slid = way - dot(way, surface.xyz) * surface.xyz;
    float length_ = length(slid);
    if (length_ > 0.0) position -= min(1.0, -friction * surface.w / length_) * slid;
    touches = true;
}

bool push_outside_colliders(vec3 start, inout vec3 position) {
    bool touches = false;
    uint c = 0u;
#if (COLLIDER_KINDS & 1) != 0
    for (; c < collider_ends.x; ++c) push_out(c, distance_to_plane(c, position), start, position, touches);
#endif
#if (COLLIDER_KINDS & 2) != 0
    for (; c < collider_ends.y; ++c) push_out(c, distance_to_turned_box(c, position), start, position, touches);
#endif
#if (COLLIDER_KINDS & 4) != 0
    for (; c < collider_ends.z; ++c) push_out(c, distance_to_sphere(c, position), start, position, touches);
#endif
#if (COLLIDER_KINDS & 8) != 0
    for (; c < collider_ends.w; ++c) push_out(c, distance_to_capsule(c, position), start, position, touches);
#endif
    return touches;
}

void main() {
    uint index = global_index();
    if (index >= row_count) return;
    uint row = first_row + index;
    uvec2 entry = texelFetch(rows, int(row)).xy;
    uint n = entry.x;
    if (n == 0xFFFFFFFFu) return;
    vec4 position = texelFetch(positions, int(n));
    if (position.w == 0.0) return;
    vec3 start = start_of(n);
    vec3 way = position.xyz - start;
    float damping_time = texelFetch(start_velocities, int(n)).w;
    float inertia = 1.0 / (position.w * time_step * time_step);  // [N/m]
    NodeTerms terms = NodeTerms(inertia * (target_of(n) - position.xyz), vec3(inertia), vec3(0.0));
    vec3 if_coincident = any_direction(n);

    int slice = int(row / 64u);
    uint end = texelFetch(slice_starts, slice + 1).x;
    for (uint p = texelFetch(slice_starts, slice).x + row % 64u; p < end; p += 64u) {
        uvec4 pair = texelFetch(half_springs, int(p));
        vec2 stiffness = texelFetch(stiffnesses, int(p)).xy;
        add_half_spring(position, way, damping_time, if_coincident, pair.x, uintBitsToFloat(pair.y), stiffness.x, terms);
        add_half_spring(position, way, damping_time, if_coincident, pair.z, uintBitsToFloat(pair.w), stiffness.y, terms);
    }
    if (near_flat[n] != 0u) {
        if (clear_marks != 0u) near_flat[n] = 0u;
        end = texelFetch(corner_starts, slice + 1).x;
        for (uint k = texelFetch(corner_starts, slice).x + row % 64u; k < end; k += 64u) {
            uvec4 corner = texelFetch(tet_corners, int(k));
            if (corner.w == 0xFFFFFFFFu) break;
            vec2 rest = texelFetch(tet_rests, int(corner.w)).xy;
            add_flat_tet(position.xyz, position_of(corner.x), position_of(corner.y), position_of(corner.z), rest.x,
                         rest.y, terms);
        }
    }
#ifdef NEO_HOOKEAN
    add_neo_hookean_tets(row, terms);
#endif
    vec3 moved = position.xyz + solve(terms);
    if (push_outside_colliders(start, moved)) object_touches[entry.y] = 1u;
    out_positions[n] = vec4(moved, position.w);
}
