// What bodies have gained by a part beyond what drives them, and their vibrations, for one work group of kLanes.
// CPU twin: gelatin::cpu::EnergyAccount::measure.
#include "include/global_index.glsl"
#include "layouts/contact_tuning.glsl"
#include "layouts/step_end.glsl"
#include "layouts/step_state.glsl"
#include "layouts/end_sums.glsl"
#include "sim/implicit/rigid_part.glsl"

uniform usamplerBuffer chunk_starts;  // of each object, and the end
uniform uint object_count;
layout(std430) readonly buffer ObjectSums { double object_sums[]; };

uint first_chunk(uint o) { return texelFetch(chunk_starts, int(o)).x; }

double energy_sum(uint o, uint k) { return object_sums[o * kObjectSums + k]; }
double part_sum(uint o, uint k) { return object_sums[o * kObjectSums + kEnergySums + k]; }

void find_motion(uint o, out double motion[kMotionSums]) {
    for (uint k = 0u; k < kMotionSums; ++k) motion[k] = energy_sum(o, k);
}

dvec3 part_sums_of(uint o, uint k) { return dvec3(part_sum(o, k), part_sum(o, k + 1u), part_sum(o, k + 2u)); }

struct BodyGain {
    BodyEnergy after;   // where the part ends
    double before_all, after_all;  // kinetic, elastic and potential energy where it began and ends [J]
    double owed, dues;  // of what is owed more than the slack [J]
    double vibrations;  // [J]
    float gained;       // beyond vibrations, as a part of the energy then; infinite where something is not finite
};

// @param motion of energy_sums
BodyGain gain_of(uint o, BodyPace pace, BodyEnergy before, double motion[kMotionSums], bool is_free) {
    BodyGain gain;
    gain.after = BodyEnergy(energy_sum(o, kElastic), part_sum(o, kContactsAtEnd), before.debt);
    double kinetic = energy_sum(o, kKinetic), potential = energy_sum(o, kPotential);
    double potential_before = part_sum(o, kStartPotential);
    double motions = before.elastic + part_sum(o, kStartKinetic), moves = gain.after.elastic + kinetic;
    gain.before_all = motions + potential_before;
    gain.after_all = moves + potential;
    double slack = double(kLeastEnergy) + double(kEnergyRounding) * (moves + abs(potential));
    double gained = moves + gain.after.contacts - motions - part_sum(o, kWork);
    dvec3 momentum = triple(motion, kMomentum);
    if (pace.is_held != 0u) {
        gained += potential - potential_before;
    } else {
        // What nothing holds moves on as a whole, and falls, as it does.
        dvec3 momentum_before = part_sums_of(o, kStartMomentum);
        double twice = 2.0LF * double(pace.velocity.w), whole = dot(momentum_before, momentum_before) / twice;
        gained -= dot(momentum, momentum) / twice - whole;
        motions = max(motions - whole, 0.0LF);
    }
    slack += double(kSlackOfEnergy) * motions;
    gain.owed = before.debt + gained - before.contacts;
    gain.dues = max(gain.owed - slack, 0.0LF);
    gain.vibrations = kinetic;
    if (is_free) {
        RigidPart rigid = rigid_part_of(motion);
        dvec3 turns = triple(motion, kAngular) - cross(rigid.center, momentum);
        gain.vibrations = max(kinetic - 0.5LF * (dot(rigid.velocity, momentum) + dot(rigid.spin, turns)), 0.0LF);
    }
    double beyond = max(gained - part_sum(o, kContactsAtStart) - slack, 0.0LF) - gain.vibrations;
    // Of a maximum with what is no number either may come out.
    double all = gained + slack + gain.vibrations;
    if (isnan(all) || isinf(all)) gain.gained = uintBitsToFloat(0x7F800000u);
    else gain.gained = beyond > 0.0LF ? float(beyond / (beyond + motions)) : 0.0;
    return gain;
}

shared float lane_gains[kLanes];

// Of all invocations the most.
float most_gained(float own) {
    uint lane = gl_LocalInvocationID.x;
    lane_gains[lane] = own;
    for (uint half_ = kLanes / 2u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (lane < half_) lane_gains[lane] = max(lane_gains[lane], lane_gains[lane + half_]);
    }
    barrier();
    return lane_gains[0];
}
