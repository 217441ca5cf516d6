// Lists the faces that are not wholly before all surfaces of other objects: what the next view draws. A face that is cannot
// touch any other object (Govindaraju, Redon, Lin, Manocha: CULLIDE, Graphics Hardware 2003). The order in which fragments
// come changes the order of the list alone.
// Test: tests/gpu/depth/cull_by_depth_test.cpp.
#include "sim/depth/footprint_pixel.glsl"
#include "layouts/draw.glsl"

uniform sampler2D nearest_depth;
uniform usampler2D nearest_object;
uniform sampler2D nearest_other_depth;
layout(std430) buffer FaceViews { uint face_views[]; };
layout(std430) writeonly buffer ObjectViews { uint object_views[]; };
layout(std430) buffer Draws { Draw draws[]; };
layout(std430) writeonly buffer HiddenFaces { uint hidden_faces[]; };
uniform uint view;  // 1 .. VIEW_COUNT

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool is_nearest = footprint.object == texelFetch(nearest_object, pixel, 0).x;
    float others = is_nearest ? texelFetch(nearest_other_depth, pixel, 0).x : texelFetch(nearest_depth, pixel, 0).x;
    if (!covers_pixel() || greatest_depth() < others) return;
    if (face_views[footprint.face] == view || atomicExchange(face_views[footprint.face], view) == view) return;
    hidden_faces[atomicAdd(draws[view].count, 1u)] = footprint.face;
    object_views[footprint.object] = view;
}
