// sim/collision/list_candidates.comp of the faces that depth has not culled.
// Test: tests/gpu/depth/cull_by_depth_test.cpp.
#include "sim/depth/hidden.glsl"
#include "sim/collision/list_candidates.comp"
