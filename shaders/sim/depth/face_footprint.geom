// The rectangle of pixels round a face, seen along an axis, with what the fragment shaders need to keep to the pixels that
// the face touches: no centre of a pixel need lie in it. Rounding is covered, so that nothing that touches a pixel's square
// is lost: pixels are moved over by 2^-7, depths by 2^-20 and, along a slope, by 2^-8 of the face's range.
// After Govindaraju, Lin, Manocha: Fast and reliable collision culling using graphics hardware, VRST 2004.
// Test: tests/gpu/depth/cull_by_depth_test.cpp.
#define FOOTPRINT out
#include "sim/depth/footprint.glsl"
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

uniform samplerBuffer positions;    // xyz [m]
uniform usamplerBuffer faces;       // Face
uniform samplerBuffer view_space;   // lower corner [m], scale [1/m]
uniform uint axis;         // of sight: 0, 1, 2
uniform uint from_behind;  // 1: sight goes down the axis
uniform float resolution;  // [pixels a side]

flat in uint drawn_face[];

const float kDeepest = 0.98;        // before the depth of nothing, 1
const float kReach = 0.5 + 0.0078;  // from a pixel's centre to its edge [pixels]

// Pixels and depth. Rounded the same way in each program that draws a view, and never back and forth along an axis.
vec3 project(uint node) {
    vec3 lower = texelFetch(view_space, 0).xyz;
    vec3 scale = texelFetch(view_space, 1).xyz;
    precise vec3 place = kDeepest * min((texelFetch(positions, int(node)).xyz - lower) * scale, vec3(1.0));
    precise float depth = from_behind != 0u ? kDeepest - place[axis] : place[axis];
    return vec3(resolution * vec2(place[(axis + 1u) % 3u], place[(axis + 2u) % 3u]), depth);
}

// Turned towards the third corner. Where rounding turns it the wrong way the face is thinner than rounding, and reaches no
// pixel that this loses.
vec3 inner_side(vec2 from, vec2 to, vec2 third) {
    vec2 normal = vec2(from.y - to.y, to.x - from.x);
    if (dot(normal, third - from) < 0.0) normal = -normal;
    return vec3(normal, kReach * (abs(normal.x) + abs(normal.y)) - dot(normal, from));
}

float squared_length(vec2 v) { return dot(v, v); }

void emit(vec2 pixel, vec3 a, vec3 b, vec3 c, uvec4 nodes) {
    float shallowest = min(a.z, min(b.z, c.z));
    float deepest = max(a.z, max(b.z, c.z));
    vec3 normal = cross(b - a, c - a);
    // Seen from the side, or smaller than a pixel: its slope is lost in rounding, and its whole depth is in a pixel.
    float size = max(squared_length((b - a).xy), max(squared_length((c - b).xy), squared_length((a - c).xy)));
    bool is_steep = size < 1.0 || abs(normal.z) * 1024.0 < size;
    vec2 slope = is_steep ? vec2(0.0) : -normal.xy / normal.z;

    footprint.edges[0] = inner_side(a.xy, b.xy, c.xy);
    footprint.edges[1] = inner_side(b.xy, c.xy, a.xy);
    footprint.edges[2] = inner_side(c.xy, a.xy, b.xy);
    footprint.corner = a;
    footprint.slope = slope;
    footprint.depth_reach = is_steep ? deepest - shallowest
                                     : kReach * (abs(slope.x) + abs(slope.y)) + (deepest - shallowest) / 256.0 + 1e-6;
    footprint.depth_range = vec2(shallowest, deepest);
    footprint.face = drawn_face[0];
    footprint.object = nodes.w;
    gl_Position = vec4(2.0 * pixel / resolution - 1.0, 0.0, 1.0);
    EmitVertex();
}

void main() {
    uvec4 nodes = texelFetch(faces, int(drawn_face[0]));  // and object
    vec3 a = project(nodes.x);
    vec3 b = project(nodes.y);
    vec3 c = project(nodes.z);
    vec2 low = max(floor(min(a, min(b, c)).xy + 0.5 - kReach), vec2(0.0));
    vec2 high = min(ceil(max(a, max(b, c)).xy - 0.5 + kReach), vec2(resolution));
    emit(low, a, b, c, nodes);
    emit(vec2(high.x, low.y), a, b, c, nodes);
    emit(vec2(low.x, high.y), a, b, c, nodes);
    emit(high, a, b, c, nodes);
    EndPrimitive();
}
