// Boxes round what nodes do in a part, relative to the motion of their object: two meet that are nearer than both slacks and the
// reach. CPU twin: gelatin::cpu::FindPairs.
#include "layouts/contact_tuning.glsl"
#include "sim/collision/bounds.glsl"
#include "sim/collision/rounding.glsl"

uniform samplerBuffer positions;  // where nodes begin, xyz [m]
uniform samplerBuffer path_ends;  // xyz [m]
uniform samplerBuffer thicknesses;  // by object [m]
uniform samplerBuffer motions;      // by object [m]

vec3 position(uint node) { return texelFetch(positions, int(node)).xyz; }
vec3 path_end(uint node) { return texelFetch(path_ends, int(node)).xyz; }
vec3 motion_of(uint object) { return texelFetch(motions, int(object)).xyz; }
float thickness_of(uint object) { return texelFetch(thicknesses, int(object)).x; }

Bounds joined(Bounds a, Bounds b) { return Bounds(min(a.min, b.min), max(a.max, b.max)); }
Bounds swept(Bounds box, vec3 motion) { return Bounds(box.min + min(motion, 0.0), box.max + max(motion, 0.0)); }

// Of boxes of an object.
struct Frame {
    vec3 motion;
    float width;  // of the margin [m]
};
Frame frame_of(uint object) {
    return Frame(motion_of(object), (1.0 + kPathSlack) * thickness_of(object) * (1.0 + 8.0 * kEpsilon));
}

// As gelatin::cpu::BoxMargin.
Bounds path_bounds(uint node, Frame frame) {
    vec3 from = position(node), to = path_end(node) - frame.motion;
    vec3 margin_from = frame.width + 2.0 * kEpsilon * abs(from), margin_to = frame.width + 2.0 * kEpsilon * abs(to);
    return Bounds(min(from - margin_from, to - margin_to), max(from + margin_from, to + margin_to));
}
Bounds path_bounds(uvec3 nodes, Frame frame) {
    return joined(path_bounds(nodes.x, frame), joined(path_bounds(nodes.y, frame), path_bounds(nodes.z, frame)));
}
