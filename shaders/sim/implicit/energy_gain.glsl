// What a body has gained by a part beyond what drives it, and what its island has. To be included after sim/implicit/object_sums.glsl.
// CPU twin: gelatin::cpu::EnergyAccount::measure.
#include "layouts/contact_tuning.glsl"
#include "layouts/step_end.glsl"
#include "layouts/step_state.glsl"

// Sums over the bodies of an island: masses; what they owe and have gained; what is too small to count; kinetic and elastic energy
// before; momenta where the part ends and where it began; vibrations.
const uint kMasses = 0u, kOwed = 1u, kGained = 2u, kSlack = 3u, kMotionsBefore = 4u, kMomenta = 5u, kMomentaBefore = 8u,
           kVibrating = 11u, kGainSums = 12u;

// What a body moves with beside its motion as a rigid one [J].
double vibrations_of(uint o, bool is_free) {
    double kinetic = energy_sum(o, kKinetic), motion[kMotionSums];
    if (!is_free) return kinetic;
    find_motion(o, motion);
    RigidPart rigid = rigid_part_of(motion);
    dvec3 momentum = triple(motion, kMomentum), turns = triple(motion, kAngular) - cross(rigid.center, momentum);
    return max(kinetic - 0.5LF * (dot(rigid.velocity, momentum) + dot(rigid.spin, turns)), 0.0LF);
}

void add_gain(uint o, BodyPace pace, BodyEnergy before, inout double sums[kGainSums]) {
    double motions = energy_sum(o, kElastic) + energy_sum(o, kKinetic), potential = energy_sum(o, kPotential);
    double motions_before = before.elastic + part_sum(o, kStartKinetic);
    double gained = motions + part_sum(o, kContactsAtEnd) - motions_before - part_sum(o, kWork);
    if (pace.is_held != 0u) gained += potential - part_sum(o, kStartPotential);
    sums[kMasses] += double(pace.velocity.w);
    sums[kOwed] += before.debt + gained - before.contacts;
    sums[kGained] += gained - part_sum(o, kContactsAtStart);
    sums[kSlack] +=
        double(kLeastEnergy) * double(pace.velocity.w) + double(kEnergyRounding) * (motions + abs(potential));
    sums[kMotionsBefore] += motions_before;
    for (uint k = 0u; k < 3u; ++k) {
        sums[kMomenta + k] += energy_sum(o, kMomentum + k);
        sums[kMomentaBefore + k] += part_sum(o, kStartMomentum + k);
    }
    sums[kVibrating] += object_sums[o * kObjectSums + kVibrations];
}

// @return kIslandSums
double[kIslandSums] gain_of(double sums[kGainSums], bool is_held) {
    double owed = sums[kOwed], gained = sums[kGained], motions = sums[kMotionsBefore], vibrations = sums[kVibrating];
    if (!is_held) {
        // What nothing holds moves on as a whole, and falls, as it does.
        dvec3 now = dvec3(sums[kMomenta], sums[kMomenta + 1u], sums[kMomenta + 2u]);
        dvec3 before = dvec3(sums[kMomentaBefore], sums[kMomentaBefore + 1u], sums[kMomentaBefore + 2u]);
        double twice = 2.0LF * sums[kMasses], whole = dot(before, before) / twice;
        double more = dot(now, now) / twice - whole;
        owed -= more;
        gained -= more;
        motions = max(motions - whole, 0.0LF);
    }
    double slack = sums[kSlack] + double(2.0 * kHardly) * motions;
    double beyond = max(gained - slack, 0.0LF) - vibrations;
    double island[kIslandSums];
    island[kIslandOwed] = owed;
    island[kIslandDues] = max(owed - slack, 0.0LF);
    island[kIslandVibrations] = vibrations;
    island[kIslandMass] = sums[kMasses];
    island[kIslandGain] = beyond > 0.0LF ? beyond / (beyond + motions) : 0.0LF;
    // Of a maximum with what is no number either may come out.
    double all = gained + slack + vibrations;
    if (isnan(all) || isinf(all)) island[kIslandGain] = double(uintBitsToFloat(0x7F800000u));
    return island;
}
