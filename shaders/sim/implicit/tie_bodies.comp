// With whom bodies go on. Of a force Newmark's scheme leaves a part to later parts, of a body and of what it touched alike. So where
// bodies that touched each other go on by different schemes, what is left is dropped for all of them. And how many pairs of objects have rows. One work group.
// CPU twin: gelatin::cpu::TimeScheme::tie. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kLanes = 256u;
#include "layouts/dispatch.glsl"
#include "layouts/tries.glsl"
#include "layouts/step_end.glsl"
#include "layouts/step_state.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/island_bodies.glsl"
layout(local_size_x = 256) in;

const uint kNewmarks = 1u, kEulers = 2u;
uniform uint body_count;
layout(std430) readonly buffer Paces { BodyPace paces[]; };
layout(std430) coherent buffer BodyEnergies { BodyEnergy energies[]; };

layout(std430) writeonly buffer Dispatches { Dispatch dispatches[]; };

shared uint has_changed, pair_count;

void wait_for_group() {
    memoryBarrierBuffer();
    memoryBarrierShared();
    barrier();
}

// Both get the lesser label.
void unite(uint a, uint b) {
    uint label_a = energies[a].next_tied, label_b = energies[b].next_tied;
    if (label_a == label_b) return;
    has_changed = 1u;
    atomicMin(energies[a].next_tied, label_b);
    atomicMin(energies[b].next_tied, label_a);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (lane == 0u) pair_count = 0u;
    wait_for_group();
    for (uint number = lane; number < object_count; number += kLanes)
        atomicMax(pair_count, texelFetch(islands, 3 * int(number) + 2).y);
    for (uint o = lane; o < body_count; o += kLanes) {
        energies[o].schemes = 0u;
        energies[o].next_tied = o;
    }
    wait_for_group();
    if (lane == 0u) dispatches[kPressedPairs] = Dispatch(min(pair_count, 65535u), 1u, 1u, min(pair_count, 65535u));
    for (uint o = lane; o < body_count; o += kLanes)
        atomicOr(energies[energies[o].tied].schemes, paces[o].past > 0.0 ? kNewmarks : kEulers);
    wait_for_group();
    for (uint o = lane; o < body_count; o += kLanes)
        energies[o].is_whole = energies[energies[o].tied].schemes == (kNewmarks | kEulers) ? 1u : 0u;
    for (bool is_left = true; is_left;) {
        if (lane == 0u) has_changed = 0u;
        wait_for_group();
        for (uint o = lane; o < body_count; o += kLanes) {
            uint tied = energies[o].tied;
            if ((energies[tied].schemes & kEulers) == 0u) unite(o, tied);
            unite(o, first_body(bodies_beside(o)));
            unite(o, energies[o].next_tied);
        }
        wait_for_group();
        is_left = has_changed != 0u;
        wait_for_group();
    }
}
