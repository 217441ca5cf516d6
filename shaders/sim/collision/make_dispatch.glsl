// Arguments of indirect dispatches.
#include "layouts/dispatch.glsl"

// Work groups of 64 for `count` invocations, folded into two dimensions where one is not enough.
Dispatch make_dispatch(uint count, uint groups) {
    uint rows = (groups + 65534u) / 65535u;
    return Dispatch(rows > 0u ? (groups + rows - 1u) / rows : 0u, max(rows, 1u), 1u, count);
}
Dispatch dispatch_invocations(uint count) { return make_dispatch(count, count / 64u + uint(count % 64u != 0u)); }
