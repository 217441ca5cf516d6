// Impacts of a body on colliders with restitution. Bodies bounce by their elasticity, of which parts leave little where bodies are
// stiff: those that end an impact more slowly than with the restitution times the speed at which they met get that speed, as rigid
// bodies. To be included after sim/implicit/object_sums.glsl and solve_system.glsl.
// CPU twin: gelatin::cpu::Restitution.
#include "layouts/contact_tuning.glsl"

uniform samplerBuffer colliders;  // Collider, four texels each
uniform uint collider_count;
uniform float resting_speed;      // what meets more slowly stays [m/s]
layout(std430) readonly buffer PressedSums { double pressed_sums[]; };  // by collider and chunk
layout(std430) buffer Meetings { double meetings[]; };                  // by collider and object

// A free body in a part that is made.
struct Impacting {
    float size;                    // of the part [s]
    RigidPart now;                 // where it ends
    dvec3 before, spin_before;     // its rigid motions with the arms where the part began: then,
    dvec3 after, spin_after;       // and where it ends
    double energy_before, energy;  // [J]
    dvec3 impulse, moment;         // that it gets by impacts
};

double pressed_sum(uint p, uint o, uint k) {
    double sum = 0.0LF;
    uint end = texelFetch(chunk_starts, int(o) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(o)).x; c < end; ++c) sum += pressed_sums[(p * chunk_count + c) * kPressedSums + k];
    return sum;
}
dvec3 pressed_triple(uint p, uint o, uint k) {
    return dvec3(pressed_sum(p, o, k), pressed_sum(p, o, k + 1u), pressed_sum(p, o, k + 2u));
}

dvec3 met(uint at, uint k) { return dvec3(meetings[at + k], meetings[at + k + 1u], meetings[at + k + 2u]); }

void add_impulses(uint p, uint o, uint at, double size) {
    meetings[at + kMetSize] += size * pressed_sum(p, o, kPressed);
    for (uint k = 0u; k < 3u; ++k) {
        meetings[at + kMetImpulse + k] += size * pressed_sum(p, o, kPressedForce + k);
        meetings[at + kMetArm + k] += size * pressed_sum(p, o, kPressedArm + k);
    }
}

// Ends an impact that is over, with the speed that it lacks. @return whether it is
bool strike(uint at, double restitution, double left, inout Impacting body) {
    dvec3 normal = normalize(met(at, kMetImpulse)), arm = met(at, kMetArm) / meetings[at + kMetSize];
    // Arms are from the centre of the body's mass, too.
    dvec3 turning = cross(arm, normal);
    double mobility = body.now.inverse_mass + dot(turning, body.now.inverse_inertia * turning);
    dvec3 velocity = body.now.velocity + body.now.inverse_mass * body.impulse;
    dvec3 spin = body.now.spin + body.now.inverse_inertia * body.moment;
    double apart = dot(normal, velocity + cross(spin, arm));
    if (!(apart > -left)) return false;
    // No more than it has lost: it may vibrate instead.
    double lost = max(meetings[at + kMetEnergy] - body.energy, 0.0LF);
    double lacking = min(restitution * meetings[at + kMetSpeed] - apart, sqrt(apart * apart + 2.0LF * lost * mobility) - apart);
    if (lacking > 0.0LF) {
        dvec3 impulse = lacking / mobility * normal;
        body.impulse += impulse;
        body.moment += cross(arm, impulse);
        body.energy += lacking * (apart + 0.5LF * lacking) / mobility;
    }
    return true;
}

void bounce(uint p, uint o, inout Impacting body) {
    double restitution = double(texelFetch(colliders, 4 * int(p) + 3).z);
    if (!(restitution > 0.0LF)) return;
    uint at = (p * object_count + o) * kMeeting;
    double force = pressed_sum(p, o, kPressed), size = double(body.size);
    if (!(force > 0.0LF) && !(meetings[at + kMetTime] > 0.0LF)) return;
    dvec3 pushed = pressed_triple(p, o, kPressedForce), moment = pressed_triple(p, o, kPressedMoment);
    double before = dot(pushed, body.before) + dot(moment, body.spin_before);
    double after = dot(pushed, body.after) + dot(moment, body.spin_after);
    if (!(meetings[at + kMetTime] > 0.0LF)) {
        meetings[at + kMetSpeed] = -before / force;
        meetings[at + kMetEnergy] = body.energy_before;
    }
    add_impulses(p, o, at, size);
    meetings[at + kMetTime] += size;
    double left = double(kNearly) * meetings[at + kMetSpeed], time = meetings[at + kMetTime];
    bool is_over = !(meetings[at + kMetSpeed] > double(resting_speed) && time < double(kImpactTime));
    if (!is_over && after >= -left * force && (after - before) * time <= left * force * size)
        is_over = strike(at, restitution, left, body);
    for (uint k = 0u; is_over && k < kMeeting; ++k) meetings[at + k] = 0.0LF;
}
