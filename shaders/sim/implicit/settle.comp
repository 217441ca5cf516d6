// Whether a part is made, in one work group; if so, what its end does to bodies: what they owe is taken from their vibrations, and
// they bounce off colliders. A part that has gained too much is made again, shorter. Where the shortest fails, bodies stay where they
// were.
// CPU twins: gelatin::cpu::ImplicitStep::run, EnergyAccount::settle, Restitution, TimeScheme::end.
// Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kLanes = 128u;
#include "layouts/step_end.glsl"
#include "layouts/step_state.glsl"
#include "sim/implicit/most_gained.glsl"
#include "sim/implicit/object_sums.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/settled_bodies.glsl"
#include "sim/implicit/impacts.glsl"
#include "sim/implicit/time_scheme.glsl"
layout(local_size_x = 128) in;

layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) buffer Paces { BodyPace paces[]; };
layout(std430) buffer BodyEnergies { BodyEnergy energies[]; };
layout(std430) buffer BodyChanges { BodyChange changes[]; };

// How fast a free body's momenta have changed. @param angular momentum about its centre of mass
void find_rates(uint o, float size, dvec3 momentum, dvec3 angular) {
    BodyPace pace = paces[o];
    Scheme scheme = scheme_of(size, energies[o].is_whole != 0u ? 0.0 : pace.past);
    dvec3 before = part_sums_of(o, kStartMomentum);
    dvec3 angular_before = part_sums_of(o, kStartAngular) - cross(part_sums_of(o, kStartArm) / double(pace.velocity.w), before);
    paces[o].force = vec4(rate_by(scheme, pace.force.xyz, vec3(momentum - before)), 0.0);
    paces[o].moment = vec4(rate_by(scheme, pace.moment.xyz, vec3(angular - angular_before)), 0.0);
}

// What an island owes, as far as it vibrates. Its bodies have shares of what is left by their masses. @return the body's [J]
double pay(uint o, inout BodyChange change) {
    double part = part_paid(o), left = max(island_sum(o, kIslandOwed), 0.0LF) - part * island_sum(o, kIslandVibrations);
    change.center.w = float(1.0LF - sqrt(1.0LF - part));
    return double(paces[o].velocity.w) / island_sum(o, kIslandMass) * left;
}

// Of a free body, what happens to its motion; else its impacts are forgotten.
void end_motion(uint o, float size, bool is_free, double motion[kMotionSums], inout BodyChange change) {
    if (!is_free) {
        for (uint p = 0u; p < collider_count; ++p)
            for (uint k = 0u; k < kMeeting; ++k) meetings[(p * object_count + o) * kMeeting + k] = 0.0LF;
        return;
    }
    dvec3 momentum = triple(motion, kMomentum);
    Impacting body;
    body.size = size;
    body.now = rigid_part_of(motion);
    rigid_velocity(o, part_sums_of(o, kStartMomentum), part_sums_of(o, kStartAngular), body.before, body.spin_before);
    rigid_velocity(o, momentum, energy_sums_of(o, kTurning), body.after, body.spin_after);
    body.energy_before = energy_before(o, energies[o].elastic);
    body.energy = energy_after(o);
    body.impulse = body.moment = dvec3(0.0LF);
#ifdef PAIRS
    BodyChange by_others = changes[o];
    body.energy += double(by_others.center.w);
    body.impulse = dvec3(by_others.velocity.xyz);
    body.moment = dvec3(by_others.spin.xyz);
#endif
    for (uint p = 0u; p < collider_count; ++p) bounce(p, o, body);
    double part = double(change.center.w);
    change.center.xyz = vec3(body.now.center) + texelFetch(bodies, 5 * int(o)).xyz;
    change.velocity = vec4(vec3(part * body.now.velocity), 0.0);
    change.spin = vec4(vec3(part * body.now.spin), 0.0);
    change.bounce = vec4(vec3(body.now.inverse_mass * body.impulse), 0.0);
    change.turn = vec4(vec3(body.now.inverse_inertia * body.moment), 0.0);
    find_rates(o, size, momentum, triple(motion, kAngular) - cross(body.now.center, momentum));
}

void make(uint o, float size) {
    bool is_free = texelFetch(bodies, 5 * int(o)).w > 0.0, was_stopped = changes[o].action == 3u;
    double motion[kMotionSums];
    find_motion(o, motion);
    BodyChange change = BodyChange(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), 1u, 0u, 0u, 0u);
    double debt = pay(o, change);
    end_motion(o, size, is_free, motion, change);
    paces[o].is_struck = was_stopped ? 1u : 0u;
    energies[o].elastic = energy_sum(o, kElastic);
    energies[o].contacts = part_sum(o, kContactsAtEnd);
    energies[o].debt = debt;
    changes[o] = change;
}

// What is not finite.
void stay(uint o, float size) {
    paces[o].is_struck = 1u;
    find_rates(o, size, dvec3(0.0LF), dvec3(0.0LF));
    energies[o].contacts = energies[o].debt = 0.0LF;
    changes[o] = BodyChange(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), 2u, 0u, 0u, 0u);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    StepClock now = clock[0];
    float gained = most_gained();
    bool is_done = is_made(now, gained);
    for (uint o = lane; o < object_count; o += kLanes) {
        if (!is_done || o >= body_count) changes[o].action = is_done ? 1u : 0u;  // what is no body goes where it goes
        else if (is_finite(gained)) make(o, now.step);
        else stay(o, now.step);
        if (is_done) energies[o].tied = energies[o].next_tied;
    }
    if (lane != 0u) return;
    now.gained = gained;
    now.damps = 0u;
    if (is_done) {
        now.left -= now.step;
        now.longest = 2.0 * now.step;
        now.last_step = now.step;
        ++now.made;
        now.is_over = now.left > 0.5 * shortest_part(now) ? 0u : 1u;
    } else {
        now.step *= 0.5;
        now.goes_on = 0u;
    }
    now.is_guarded = clock[0].is_guarded;
    clock[0] = now;
}
