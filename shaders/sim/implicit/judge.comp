// Whether a part has gained energy, in one work group. Then it is made again by implicit Euler's scheme, if any body went by another.
// And how bodies move beside what they touch. GUARDED: again, where the guard has moved nodes; if it has, these are stopped.
// CPU twins: gelatin::cpu::ImplicitStep::run, EnergyAccount::measure, Paces::find. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kLanes = 128u;
#include "layouts/step_end.glsl"
#include "layouts/step_state.glsl"
#ifndef GUARDED
#include "sim/implicit/tries.glsl"
#endif
#include "sim/implicit/most_gained.glsl"
#include "sim/implicit/object_sums.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/island_bodies.glsl"
layout(local_size_x = 128) in;

layout(std430) buffer Paces { BodyPace paces[]; };

#ifdef GUARDED
layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) readonly buffer GuardSums { double guard_sums[]; };  // by chunk
layout(std430) writeonly buffer BodyChanges { BodyChange changes[]; };

double guard_sum(uint o, uint k) {
    double sum = 0.0LF;
    uint end = texelFetch(chunk_starts, int(o) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(o)).x; c < end; ++c) sum += guard_sums[c * kGuardSums + k];
    return sum;
}

// An island that nothing holds keeps its momentum and angular momentum.
void stop(IslandBodies island) {
    uint first = first_body(island);
    vec3 origin = center_of(first);
    BodyChange change = BodyChange(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), 0u, 0u, 0u, 0u);
    double motion[kMotionSums], own[kMotionSums];
    for (uint k = 0u; k < kMotionSums; ++k) motion[k] = 0.0LF;
    for (uint at = island.first; at < island.end; ++at) {
        uint o = body_at(island, at);
        if (guard_sum(o, kStopped) > 0.0LF) change.action = 3u;
        find_motion(o, own);
        for (uint k = 0u; k < 3u; ++k) {
            own[kMomentum + k] = guard_sum(o, kChange + k);
            own[kAngular + k] = guard_sum(o, kChangeMoment + k);
        }
        add_body(motion, own, dvec3(center_of(o)) - dvec3(origin));
    }
    if (change.action != 0u && paces[first].is_held == 0u) {
        RigidPart lost = rigid_part_of(motion);
        change.center = vec4(vec3(lost.center) + origin, 0.0);
        change.velocity = vec4(-vec3(lost.velocity), 0.0);
        change.spin = vec4(-vec3(lost.spin), 0.0);
    }
    for (uint at = island.first; at < island.end; ++at) changes[body_at(island, at)] = change;
}
#else
uniform float slow;  // [m/s]

// 0: moving; 1: calm, hardly vibrates, and touches others but hardly goes towards or away from them; 2: still, hardly moves at all.
uint pace_of(uint o, float mass) {
    float pressing = float(part_sum(o, kPressing)), fastest = float(part_sum(o, kGreatestSpeed));
    float vibrations = sqrt(float(part_sum(o, kSquares)) / mass);
    bool is_calm = pressing > 0.0 && vibrations < slow && float(part_sum(o, kApproach)) < slow * pressing;
    return !is_calm ? 0u : fastest < slow ? 2u : 1u;
}
#endif

void main() {
    uint lane = gl_LocalInvocationID.x;
#ifdef GUARDED
    float is_guarded = 0.0;
    for (uint o = lane; o < body_count; o += kLanes) is_guarded = max(is_guarded, guard_sum(o, kHeldBack) > 0.0LF ? 1.0 : 0.0);
    is_guarded = most_of_group(is_guarded);
    barrier();
    if (!(is_guarded > 0.0)) return;
#endif
    float gained = most_gained();
#ifdef GUARDED
    for (uint o = lane; o < body_count && gained > 0.0; o += kLanes) {
        IslandBodies island = bodies_beside(o);
        if (first_body(island) == o) stop(island);
    }
    if (lane == 0u) clock[0].is_guarded = 1u;
#else
    for (uint o = lane; o < body_count; o += kLanes) paces[o].pace = pace_of(o, paces[o].velocity.w);
    StepClock now = clock[0];
    now.is_guarded = 0u;
    now.gained = gained;
    if (now.has_past != 0u && gained > 0.0) {
        now.damps = 1u;
        now.goes_on = 0u;
    }
    memoryBarrierBuffer();
    barrier();  // all have read it
    set_clock(now);
#endif
}
