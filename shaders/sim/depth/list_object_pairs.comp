// sim/collision/list_object_pairs.comp of the objects that depth has not culled.
// Test: tests/gpu/depth/cull_by_depth_test.cpp.
#include "sim/depth/hidden.glsl"
#include "sim/collision/list_object_pairs.comp"
