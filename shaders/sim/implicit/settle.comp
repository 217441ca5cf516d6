// Whether a part is made, in one work group; if so, what its end does to bodies: what they owe is taken from their vibrations, and
// they bounce off colliders. A part that has gained too much is made again, shorter. Where the shortest fails, bodies stay where they
// were.
// CPU twins: gelatin::cpu::ImplicitStep::run, EnergyAccount::settle, Restitution, TimeScheme::end.
// Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kLanes = 128u;
#include "layouts/step_system.glsl"
#include "sim/implicit/energy_gain.glsl"
#include "sim/implicit/impacts.glsl"
#include "sim/implicit/time_scheme.glsl"
layout(local_size_x = 128) in;

uniform samplerBuffer bodies;  // StepBody, five texels each
layout(std430) buffer Clock { StepClock clock[]; };
layout(std430) buffer Paces { BodyPace paces[]; };
layout(std430) buffer BodyEnergies { BodyEnergy energies[]; };
layout(std430) buffer BodyChanges { BodyChange changes[]; };

bool is_finite(float x) { return !isinf(x) && !isnan(x); }

// The rigid part of velocities, for momentum and angular momentum about the centre where the part began. @param mass [kg]
void rigid_velocity(uint o, double mass, dvec3 momentum, dvec3 angular, out dvec3 velocity, out dvec3 spin) {
    int first = 5 * int(o);
    vec3 d = texelFetch(bodies, first + 1).xyz, b = texelFetch(bodies, first + 2).xyz;
    dmat3 inverse_inertia = dmat3(mat3(d.x, b.z, b.y, b.z, d.y, b.x, b.y, b.x, d.z));
    velocity = momentum / mass;
    spin = double(texelFetch(bodies, first + 3).w) / mass * (inverse_inertia * angular);
}

// What is owed, as far as the body vibrates.
void pay(BodyGain gain, inout BodyChange change, inout BodyEnergy energy) {
    double left = max(gain.owed, 0.0LF);
    if (gain.dues > 0.0LF && gain.vibrations > 0.0LF) {
        double part = min(gain.dues / gain.vibrations, 1.0LF);
        change.center.w = float(1.0LF - sqrt(1.0LF - part));
        energy.kinetic -= part * gain.vibrations;
        left -= part * gain.vibrations;
    }
    energy.debt = left;
}

// Of a free body, its part of what happens at the end; else its impacts are forgotten. @return whether it is struck
bool end_motion(uint o, float size, bool is_free, double motion[kMotionSums], BodyEnergy before, inout BodyChange change,
                inout BodyEnergy energy) {
    if (!is_free) {
        for (uint p = 0u; p < collider_count; ++p)
            for (uint k = 0u; k < kMeeting; ++k) meetings[(p * object_count + o) * kMeeting + k] = 0.0LF;
        return false;
    }
    BodyPace pace = paces[o];
    Impacting body;
    body.size = size;
    body.now = rigid_part_of(motion);
    dvec3 momentum = triple(motion, kMomentum), turns = triple(motion, kAngular) - cross(body.now.center, momentum);
    dvec3 start_angular = dvec3(energy_sum(o, kStartAngular), energy_sum(o, kStartAngular + 1u), energy_sum(o, kStartAngular + 2u));
    rigid_velocity(o, double(pace.velocity.w), dvec3(pace.momentum.xyz), dvec3(pace.angular.xyz), body.before, body.spin_before);
    rigid_velocity(o, double(pace.velocity.w), momentum, start_angular, body.after, body.spin_after);
    body.energy_before = before.elastic + before.kinetic + before.potential;
    body.energy = energy.elastic + energy.kinetic + energy.potential;
    body.impulse = body.moment = dvec3(0.0LF);
    body.is_struck = false;
    double energy_then = body.energy;
    for (uint p = 0u; p < collider_count; ++p) bounce(p, o, body);
    energy.kinetic += body.energy - energy_then;
    double part = double(change.center.w);
    change.center.xyz = vec3(body.now.center) + texelFetch(bodies, 5 * int(o)).xyz;
    change.velocity = vec4(vec3(part * body.now.velocity + body.now.inverse_mass * body.impulse), 0.0);
    change.spin = vec4(vec3(part * body.now.spin + body.now.inverse_inertia * body.moment), 0.0);
    Scheme scheme = scheme_of(size, pace.past);
    paces[o].force = vec4(rate_by(scheme, pace.force.xyz, vec3(momentum + body.impulse - dvec3(pace.momentum.xyz))), 0.0);
    paces[o].moment = vec4(rate_by(scheme, pace.moment.xyz, vec3(turns + body.moment - dvec3(pace.angular.xyz))), 0.0);
    return body.is_struck;
}

void make(uint o, float size) {
    bool is_free = texelFetch(bodies, 5 * int(o)).w > 0.0, was_stopped = changes[o].action == 3u;
    double motion[kMotionSums];
    find_motion(o, motion);
    BodyEnergy before = energies[o];
    BodyGain gain = gain_of(o, paces[o], before, motion, is_free);
    BodyChange change = BodyChange(vec4(0.0), vec4(0.0), vec4(0.0), 1u, 0u, 0u, 0u);
    BodyEnergy energy = gain.after;
    pay(gain, change, energy);
    bool is_struck = end_motion(o, size, is_free, motion, before, change, energy);
    paces[o].is_struck = is_struck || was_stopped ? 1u : 0u;
    energies[o] = energy;
    changes[o] = change;
}

// What is not finite.
void stay(uint o, float size) {
    BodyPace pace = paces[o];
    Scheme scheme = scheme_of(size, pace.past);
    paces[o].is_struck = 1u;
    paces[o].force = vec4(rate_by(scheme, pace.force.xyz, -pace.momentum.xyz), 0.0);
    paces[o].moment = vec4(rate_by(scheme, pace.moment.xyz, -pace.angular.xyz), 0.0);
    energies[o] = BodyEnergy(energies[o].elastic, 0.0LF, energies[o].potential, 0.0LF, 0.0LF);
    changes[o] = BodyChange(vec4(vec3(0.0), 1.0), vec4(0.0), vec4(0.0), 2u, 0u, 0u, 0u);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    StepClock now = clock[0];
    float gained = 0.0, shortest = now.size / float(kMostParts);
    bool is_tried = now.goes_on != 0u && now.is_over == 0u;
    double motion[kMotionSums];
    for (uint o = lane; is_tried && o < object_count; o += kLanes) {
        find_motion(o, motion);
        gained = max(gained, gain_of(o, paces[o], energies[o], motion, texelFetch(bodies, 5 * int(o)).w > 0.0).gained);
    }
    gained = most_gained(gained);
    bool is_too_long = !(now.step < 2.0 * shortest) && gained > kMostGain, is_made = is_tried && !is_too_long;
    for (uint o = lane; o < object_count; o += kLanes) {
        if (!is_made) changes[o].action = 0u;
        else if (is_finite(gained)) make(o, now.step);
        else stay(o, now.step);
    }
    if (lane != 0u || !is_tried) return;
    now.gained = gained;
    now.damps = 0u;
    if (is_made) {
        now.left -= now.step;
        now.longest = 2.0 * now.step;
        now.last_step = now.step;
        ++now.made;
        now.is_over = now.left > 0.5 * shortest ? 0u : 1u;
    } else {
        now.step *= 0.5;
        now.goes_on = 0u;
    }
    now.is_guarded = clock[0].is_guarded;
    clock[0] = now;
}
