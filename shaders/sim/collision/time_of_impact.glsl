// When do two faces first touch in a step, if each corner moves along a straight line? CPU twin, which explains the method:
// src/cpu/collision/time_of_impact.h. Parity: tests/gpu/collision/time_of_impact_test.cpp. The columns of a face are its corners.
// A face of which two or three corners coincide is an edge or a node.
#include "sim/collision/nearest_points.glsl"
#include "sim/collision/rounding.glsl"

const float kRoundingBound = float(kImpactRounding) * kEpsilon, kRootBound = float(kRootRounding) * kEpsilon;
const float kNever = 2.0;

struct MovingFace {
    mat3 start;
    mat3 end;
};

// The time during which a plane across `normal` certainly separates s and t, with t on its upper side: from x to y, never if x
// > y.
vec2 separating_window(MovingFace s, MovingFace t, vec3 normal, vec3 reach) {
    precise float bound = kRoundingBound * (dot(abs(normal), reach) + kUnderflowBound);
    precise vec3 low_start = normal * s.start, low_end = normal * s.end;  // of the three corners
    precise vec3 top_start = normal * t.start, top_end = normal * t.end;
    vec2 window = vec2(0.0, 1.0);
    for (int k = 0; k < 3; ++k) {  // each corner of t with each of s
        precise vec3 start = (top_start - low_start) - bound, end = (top_end - low_end) - bound;
        bvec3 starts_apart = greaterThan(start, vec3(0.0)), ends_apart = greaterThan(end, vec3(0.0));
        vec3 root = start / (start - end);  // of use where one of the two is positive
        vec3 first = mix(mix(vec3(2.0), root * (1.0 + kRootBound), ends_apart), vec3(0.0), starts_apart);
        vec3 last = mix(mix(vec3(-1.0), root * (1.0 - kRootBound), starts_apart), vec3(1.0), ends_apart);
        window.x = max(window.x, max(first.x, max(first.y, first.z)));
        window.y = min(window.y, min(last.x, min(last.y, last.z)));
        low_start = low_start.yzx;
        low_end = low_end.yzx;
    }
    return window;
}

mat3 relative_to(vec3 origin, mat3 face) {
    precise vec3 a = face[0] - origin, b = face[1] - origin, c = face[2] - origin;
    return mat3(a, b, c);
}

vec3 largest(mat3 face) { return max(abs(face[0]), max(abs(face[1]), abs(face[2]))); }

// From 0 at the start of the step to 1 at its end, or kNever.
float time_of_impact(MovingFace s, MovingFace t) {
    // Relative to a corner that moves along: only relative motion counts.
    vec3 start = s.start[0], end = s.end[0];
    s = MovingFace(relative_to(start, s.start), relative_to(end, s.end));
    t = MovingFace(relative_to(start, t.start), relative_to(end, t.end));
    vec3 reach = max(max(largest(s.start), largest(s.end)), max(largest(t.start), largest(t.end)));

    float time = 0.0;
    for (int plane = 0; plane < kMostPlanes; ++plane) {
        vec3 normal = shortest_between(s.start + time * (s.end - s.start), t.start + time * (t.end - t.start));
        vec2 window = separating_window(s, t, normal, reach);
        if (!(window.x <= time && time < window.y)) return time;
        if (window.y == 1.0) return kNever;
        time = window.y;
    }
    return time;
}
