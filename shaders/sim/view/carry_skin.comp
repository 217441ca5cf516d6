// Where the points of a skin are, which tets carry: one invocation for each point. Differences keep the precision of small bodies
// far from the origin. CPU twin: src/model/skin.h. Parity: tests/gpu/view/carry_skin_test.cpp.
#include "include/global_index.glsl"
#include "layouts/skin_point.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;  // of nodes, xyz [m]
layout(std430) readonly buffer SkinPoints { SkinPoint skin_points[]; };
layout(std430) writeonly buffer PointPositions { vec4 point_positions[]; };  // xyz [m], 1
uniform uint point_count;

vec3 node(uint n) { return texelFetch(positions, int(n)).xyz; }

void main() {
    uint p = global_index();
    if (p >= point_count) return;
    SkinPoint point = skin_points[p];
    vec3 a = node(point.a);
    vec3 from_a = point.weights.y * (node(point.b) - a) + point.weights.z * (node(point.c) - a) +
                  point.weights.w * (node(point.d) - a);
    point_positions[p] = vec4(a + from_a, 1.0);
}
