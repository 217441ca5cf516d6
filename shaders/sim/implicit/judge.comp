// Whether a part has gained energy, in one work group. Then it is made again by implicit Euler's scheme, if any body went by another.
// And how bodies move beside what they touch. GUARDED: again, where the guard has moved nodes; if it has, these are stopped.
// CPU twins: gelatin::cpu::ImplicitStep::run, EnergyAccount::measure, Paces::find. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kLanes = 128u;
#include "sim/implicit/energy_gain.glsl"
layout(local_size_x = 128) in;

uniform samplerBuffer bodies;  // StepBody, five texels each
layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) buffer Paces { BodyPace paces[]; };
layout(std430) readonly buffer BodyEnergies { BodyEnergy energies[]; };

#ifdef GUARDED
layout(std430) readonly buffer GuardSums { double guard_sums[]; };  // by chunk
layout(std430) writeonly buffer BodyChanges { BodyChange changes[]; };

double guard_sum(uint o, uint k) {
    double sum = 0.0LF;
    for (uint c = first_chunk(o); c < first_chunk(o + 1u); ++c) sum += guard_sums[c * kGuardSums + k];
    return sum;
}

// A body that nothing holds keeps its momentum and angular momentum.
BodyChange stop(uint o, double motion[kMotionSums]) {
    BodyChange change = BodyChange(vec4(0.0), vec4(0.0), vec4(0.0), 0u, 0u, 0u, 0u);
    if (!(guard_sum(o, kStopped) > 0.0LF)) return change;
    change.action = 3u;
    if (paces[o].is_held != 0u) return change;
    for (uint k = 0u; k < 3u; ++k) {
        motion[kMomentum + k] = guard_sum(o, kChange + k);
        motion[kAngular + k] = guard_sum(o, kChangeMoment + k);
    }
    RigidPart lost = rigid_part_of(motion);
    change.center = vec4(vec3(lost.center) + texelFetch(bodies, 5 * int(o)).xyz, 0.0);
    change.velocity = vec4(-vec3(lost.velocity), 0.0);
    change.spin = vec4(-vec3(lost.spin), 0.0);
    return change;
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
    StepClock now = clock[0];
    if (now.goes_on == 0u) return;
    float gained = 0.0;
#ifdef GUARDED
    float is_guarded = 0.0;
    for (uint o = lane; o < object_count; o += kLanes) is_guarded = max(is_guarded, guard_sum(o, kHeldBack) > 0.0LF ? 1.0 : 0.0);
    is_guarded = most_gained(is_guarded);
    barrier();
    if (!(is_guarded > 0.0)) return;
#endif
    double motion[kMotionSums];
    for (uint o = lane; o < object_count; o += kLanes) {
        bool is_free = texelFetch(bodies, 5 * int(o)).w > 0.0;
        find_motion(o, motion);
        gained = max(gained, gain_of(o, paces[o], energies[o], motion, is_free).gained);
#ifndef GUARDED
        paces[o].pace = pace_of(o, paces[o].velocity.w);
#endif
    }
    gained = most_gained(gained);
#ifdef GUARDED
    for (uint o = lane; o < object_count; o += kLanes) {
        find_motion(o, motion);
        if (gained > 0.0) changes[o] = stop(o, motion);
    }
    if (lane == 0u) clock[0].is_guarded = 1u;
#else
    if (lane != 0u) return;
    clock[0].is_guarded = 0u;
    clock[0].gained = gained;
    if (now.has_past == 0u || !(gained > 0.0)) return;
    clock[0].damps = 1u;
    clock[0].goes_on = 0u;
#endif
}
