// Before the views of gpu::CullByDepth: nothing was hidden yet, the first view draws all faces, and the box that it sees
// is that of all objects. The first work group finds the box.
#include "include/global_index.glsl"
#include "layouts/box.glsl"
#include "layouts/draw.glsl"
layout(local_size_x = 256) in;

layout(std430) readonly buffer BoundingBoxes { BoundingBox bounding_boxes[]; };
layout(std430) writeonly buffer FaceViews { uint face_views[]; };
layout(std430) writeonly buffer ObjectViews { uint object_views[]; };
layout(std430) writeonly buffer Draws { Draw draws[]; };
layout(std430) writeonly buffer ViewSpace { vec4 view_space[2]; };  // its lower corner [m], its scale [1/m]
uniform uint face_count;
uniform uint object_count;

const float kLeastExtent = 1e-30;  // [m]; below, all that is seen is one pixel at one depth

shared vec3 lows[256], highs[256];

void main() {
    uint index = global_index();
    if (index < face_count) face_views[index] = 0u;
    if (index < object_count) object_views[index] = 0u;
    if (index <= uint(VIEW_COUNT)) draws[index] = Draw(index == 0u ? face_count : 0u, 1u, 0u, 0u);
    if (group_index() != 0u) return;

    uint lane = gl_LocalInvocationID.x;
    vec3 low = bounding_boxes[0].min.xyz, high = bounding_boxes[0].max.xyz;
    for (uint object = lane; object < object_count; object += 256u) {
        low = min(low, bounding_boxes[object].min.xyz);
        high = max(high, bounding_boxes[object].max.xyz);
    }
    lows[lane] = low;
    highs[lane] = high;
    barrier();
    if (lane != 0u) return;
    for (uint other = 1u; other < 256u; ++other) {
        low = min(low, lows[other]);
        high = max(high, highs[other]);
    }
    vec3 extent = high - low;
    view_space[0] = vec4(low, 0.0);
    view_space[1] = vec4(mix(vec3(0.0), 1.0 / extent, greaterThan(extent, vec3(kLeastExtent))), 0.0);
}
