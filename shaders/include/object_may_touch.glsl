// The paper's first test (2.4): bounding box against bounding box.
#include "include/pairs.glsl"
uniform uint object_count;
uniform uint ignore_boxes;  // 1: every object may touch every other

bool may_touch(uint a, uint b) {
    BoundingBox box_a = bounding_boxes[a];
    BoundingBox box_b = bounding_boxes[b];
    bool near = meet(box_a.min.xyz, box_a.max.xyz, box_b.min.xyz, box_b.max.xyz);
    return a != b && (near || ignore_boxes != 0u);
}
