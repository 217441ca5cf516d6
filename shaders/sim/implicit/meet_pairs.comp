// Impacts of two objects with restitution, as impacts.glsl has them with colliders; in one work group, if the part is made. What bodies
// get by them is in what BodyChanges have before settle.comp: impulse and moment, w of the centre: energy.
// CPU twin: gelatin::cpu::Restitution. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kLanes = 256u;
#include "layouts/dispatch.glsl"
#include "layouts/tries.glsl"
#include "layouts/step_end.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/most_gained.glsl"
#include "sim/implicit/object_sums.glsl"
#include "sim/implicit/pair_restitution.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/settled_bodies.glsl"
layout(local_size_x = 256) in;

const double kGoesOn = 0.0LF, kIsOver = 1.0LF, kMayEnd = 2.0LF;  // in kMetPress, once the press is added
uniform float resting_speed;    // what meets more slowly stays [m/s]
uniform uint meeting_capacity;
layout(std430) readonly buffer Dispatches { Dispatch dispatches[]; };
layout(std430) readonly buffer BodyEnergies { BodyEnergy energies[]; };
layout(std430) readonly buffer PairPresses { double presses[]; };
layout(std430) coherent buffer BodyChanges { BodyChange changes[]; };
// How many there are; as many as may be, by objects; and again, while they change.
layout(std430) coherent buffer PairMeetings { double meetings[]; };

uint known(uint e) { return 1u + e * kPairMeeting; }
uint changing(uint e) { return known(meeting_capacity + e); }

dvec3 met(uint at, uint k) { return dvec3(meetings[at + k], meetings[at + k + 1u], meetings[at + k + 2u]); }
dvec3 pressed(uint at, uint k) { return dvec3(presses[at + k], presses[at + k + 1u], presses[at + k + 2u]); }
uvec2 objects_of(uint at) { return uvec2(uint(meetings[at + kMetFirst]), uint(meetings[at + kMetSecond])); }

void wait_for_group() {
    memoryBarrierBuffer();
    barrier();
}

void copy(uint from, uint to) {
    for (uint k = 0u; k < kPairMeeting; ++k) meetings[to + k] = meetings[from + k];
}

bool is_free(uint o) { return texelFetch(bodies, 5 * int(o)).w > 0.0; }

// How fast a body leaves the other where the part began, or ends, times the force [W].
double leaves(uint o, dvec3 pushed, dvec3 moment, bool at_end) {
    if (!is_free(o)) return 0.0LF;
    dvec3 momentum, angular, velocity, spin;
    momentum = at_end ? energy_sums_of(o, kMomentum) : part_sums_of(o, kStartMomentum);
    angular = at_end ? energy_sums_of(o, kTurning) : part_sums_of(o, kStartAngular);
    rigid_velocity(o, momentum, angular, velocity, spin);
    return dot(pushed, velocity) + dot(moment, spin);
}

// Both, where they are pressed. @param at of the press
double leave(uint at, bool at_end) {
    uvec2 objects = uvec2(uint(presses[at + kPairFirst]), uint(presses[at + kPairSecond]));
    dvec3 pushed = pressed(at, kPairPushed);
    return presses[at + kPairApart] + leaves(objects.y, pushed, pressed(at, kPairMoment), at_end) -
           leaves(objects.x, pushed, pressed(at, kPairOpposite), at_end);
}

// Of the bodies among them [J].
double energy_of(uvec2 objects, bool at_end) {
    double sum = 0.0LF;
    for (int k = 0; k < 2; ++k) {
        uint o = objects[k];
        if (o >= body_count) continue;
        sum += at_end ? energy_after(o) + double(changes[o].center.w) : energy_before(o, energies[o].elastic);
    }
    return sum;
}

// What is known, and what presses for the first time and fast enough. @return how many
uint find_meetings(uint known_count) {
    uint lane = gl_LocalInvocationID.x, count = known_count, pair_count = dispatches[kPressedPairs].count;
    for (uint e = lane; e < known_count; e += kLanes) {
        copy(known(e), changing(e));
        meetings[changing(e) + kMetPress] = 0.0LF;
    }
    wait_for_group();
    for (uint base = 0u; base < pair_count; base += kLanes) {
        uint p = base + lane, at = p * kPairSums, all, is_new = 0u;
        if (p < pair_count && presses[at + kPairForce] > 0.0LF) {
            is_new = -leave(at, false) > double(resting_speed) * presses[at + kPairForce] ? 1u : 0u;
            for (uint e = 0u; e < known_count; ++e) {
                bool is_same = meetings[known(e) + kMetFirst] == presses[at + kPairFirst] &&
                               meetings[known(e) + kMetSecond] == presses[at + kPairSecond];
                if (!is_same) continue;
                meetings[changing(e) + kMetPress] = double(p + 1u);
                is_new = 0u;
            }
        }
        uint place = count + count_before(is_new, all);
        count = min(count + all, meeting_capacity);
        if (is_new == 0u || place >= meeting_capacity) continue;
        for (uint k = 0u; k < kPairMeeting; ++k) meetings[changing(place) + k] = 0.0LF;
        meetings[changing(place) + kMetFirst] = presses[at + kPairFirst];
        meetings[changing(place) + kMetSecond] = presses[at + kPairSecond];
        meetings[changing(place) + kMetPress] = double(p + 1u);
    }
    return count;
}

void add_press(uint at, double size) {
    uint press = uint(meetings[at + kMetPress]);
    double force = 0.0LF, before = 0.0LF, after = 0.0LF;
    if (press > 0u) {
        uint from = (press - 1u) * kPairSums;
        force = presses[from + kPairForce];
        before = leave(from, false);
        after = leave(from, true);
        meetings[at + kMetSize] += size * force;
        for (uint k = 0u; k < 3u; ++k) {
            meetings[at + kMetImpulse + k] += size * presses[from + kPairPushed + k];
            meetings[at + kMetArm + k] += size * presses[from + kPairArm + k];
            meetings[at + kMetHeld + k] += size * presses[from + kPairHeld + k];
        }
    }
    if (!(meetings[at + kMetTime] > 0.0LF)) {
        meetings[at + kMetSpeed] = -before / force;
        meetings[at + kMetEnergy] = energy_of(objects_of(at), false);
    }
    meetings[at + kMetTime] += size;
    double left = double(kNearly) * meetings[at + kMetSpeed], time = meetings[at + kMetTime];
    bool counts = meetings[at + kMetSpeed] > double(resting_speed) && time < double(kImpactTime);
    bool may_end = after >= -left * force && (after - before) * time <= left * force * size;
    meetings[at + kMetPress] = !counts ? kIsOver : may_end ? kMayEnd : kGoesOn;
}

// In the order of their objects, to where they are known.
void sort_meetings(uint count) {
    for (uint e = gl_LocalInvocationID.x; e < count; e += kLanes) {
        uvec2 own = objects_of(changing(e));
        uint before = 0u;
        for (uint k = 0u; k < count; ++k) {
            uvec2 other = objects_of(changing(k));
            if (other.x < own.x || (other.x == own.x && other.y < own.y)) ++before;
        }
        copy(changing(e), known(before));
    }
}

// As it is by now.
RigidPart body_now(uint o) {
    double motion[kMotionSums];
    find_motion(o, motion);
    RigidPart body = rigid_part_of(motion);
    body.center += dvec3(center_of(o));
    body.velocity += body.inverse_mass * dvec3(changes[o].velocity.xyz);
    body.spin += body.inverse_inertia * dvec3(changes[o].spin.xyz);
    return body;
}

// Ends an impact that is over, with the speed that it lacks. @return whether it is
bool strike(uint at) {
    uvec2 objects = objects_of(at);
    dvec3 normal = normalize(met(at, kMetImpulse)), held = met(at, kMetHeld), point = dvec3(0.0LF);
    RigidPart sides[2];
    uint free_count = 0u;
    for (int k = 0; k < 2; ++k) {
        if (!is_free(objects[k])) continue;
        sides[k] = body_now(objects[k]);
        point = sides[k].center + met(at, kMetArm) / meetings[at + kMetSize];
        ++free_count;
    }
    double mobility = 0.0LF, apart = dot(normal, held) / meetings[at + kMetSize];
    for (int k = 0; k < 2; ++k) {
        if (!is_free(objects[k])) continue;
        dvec3 arm = point - sides[k].center, turning = cross(arm, normal);
        mobility += sides[k].inverse_mass + dot(turning, sides[k].inverse_inertia * turning);
        apart += (k == 0 ? -1.0LF : 1.0LF) * dot(normal, sides[k].velocity + cross(sides[k].spin, arm));
    }
    if (free_count == 0u) return true;  // what was free is held by now
    if (!(apart > -double(kNearly) * meetings[at + kMetSpeed])) return false;
    double lacking = double(restitution_of(objects)) * meetings[at + kMetSpeed] - apart;
    // No more than they have lost: bodies may vibrate instead.
    double lost = max(meetings[at + kMetEnergy] - energy_of(objects, true), 0.0LF);
    if (held == dvec3(0.0LF)) lacking = min(lacking, sqrt(apart * apart + 2.0LF * lost * mobility) - apart);
    for (int k = 0; k < 2 && lacking > 0.0LF; ++k) {
        uint o = objects[k];
        if (!is_free(o)) continue;
        dvec3 impulse = (k == 0 ? -lacking : lacking) / mobility * normal;
        changes[o].velocity.xyz += vec3(impulse);
        changes[o].spin.xyz += vec3(cross(point - sides[k].center, impulse));
        changes[o].center.w += float(lacking * (apart + 0.5LF * lacking) / mobility / double(free_count));
    }
    return true;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    StepClock now = clock[0];
    float gained = most_gained();
    if (!is_made(now, gained) || !is_finite(gained)) return;
    for (uint o = lane; o < body_count; o += kLanes) {
        changes[o].center.w = 0.0;
        changes[o].velocity = changes[o].spin = vec4(0.0);
    }
    uint count = find_meetings(uint(meetings[0]));
    wait_for_group();
    for (uint e = lane; e < count; e += kLanes) add_press(changing(e), double(now.step));
    wait_for_group();
    sort_meetings(count);
    wait_for_group();
    if (lane != 0u) return;
    uint kept = 0u;
    for (uint e = 0u; e < count; ++e) {
        double state = meetings[known(e) + kMetPress];
        if (state == kIsOver || (state == kMayEnd && strike(known(e)))) continue;
        copy(known(e), known(kept));
        ++kept;
    }
    meetings[0] = double(kept);
}
