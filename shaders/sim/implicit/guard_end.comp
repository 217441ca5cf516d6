// What is blocked stays where it is, and others are wanted where they were; islands that fail go with their frames. Surface nodes that
// end beside their paths get new ones. CPU twins: gelatin::cpu::Guard::run, ImplicitStep::guard.
// Parity: tests/gpu/implicit/pair_guard_test.cpp.
#include "sim/implicit/guarded_pairs.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer thicknesses;  // of objects [m]
layout(std430) readonly buffer Marks { uint object_marks[]; };
layout(std430) buffer EndPositions { vec4 end_positions[]; };
layout(std430) buffer PathEnds { vec4 path_ends[]; };
layout(std430) writeonly buffer Guard { GuardState guard[]; };

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    uint object = object_of(n), marks = object_marks[island_of(object)];
    vec4 end = end_positions[n];
    if ((marks & (kHasBlocked | kHasFailed)) != 0u) {
        bool is_blocked = is_held(n) && (object_marks[object] & kIsBlocked) != 0u;
        end.xyz = start_of(n) + frame_of(object);
        if ((marks & kHasBlocked) != 0u && !is_blocked) end.xyz = texelFetch(wanted, int(n)).xyz;
        end_positions[n] = end;
        guard[0].is_changed = 1u;
        if ((marks & kHasBlocked) != 0u) guard[0].needs_again = 1u;
    }
    bool is_on_surface = (texelFetch(node_objects, int(n)).x & 1u) != 0u;
    float slack = kPathSlack * texelFetch(thicknesses, int(object)).x;
    if (!is_on_surface || distance(end.xyz, path_ends[n].xyz) <= slack) return;
    path_ends[n].xyz = end.xyz;
    guard[0].needs_again = 1u;
}
