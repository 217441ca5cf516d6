// Whether a part is made, and bodies where it ends. To be included after sim/implicit/most_gained.glsl, object_sums.glsl and
// solve_system.glsl.
// CPU twins: gelatin::cpu::ImplicitStep::run, EnergyAccount::settle, RigidLevel::velocity.
#include "layouts/contact_tuning.glsl"
#include "layouts/step_state.glsl"
#include "sim/implicit/inverse_inertia.glsl"

bool is_finite(float x) { return !isinf(x) && !isnan(x); }

float shortest_part(StepClock now) { return now.size / float(kMostParts); }

// One that has gained too much is made again, shorter, if it can be.
bool is_made(StepClock now, float gained) { return now.step < 2.0 * shortest_part(now) || !(gained > kSlightly); }

double island_sum(uint o, uint k) { return island_sums[o * kIslandSums + k]; }

// Of its energy of vibrations what an island pays of what it owes.
double part_paid(uint o) {
    double dues = island_sum(o, kIslandDues), vibrations = island_sum(o, kIslandVibrations);
    return dues > 0.0LF && vibrations > 0.0LF ? min(dues / vibrations, 1.0LF) : 0.0LF;
}

// Of a body when the part began [J]. @param elastic
double energy_before(uint o, double elastic) {
    return elastic + part_sum(o, kStartKinetic) + part_sum(o, kStartPotential);
}

// And when it has paid.
double energy_after(uint o) {
    return energy_sum(o, kElastic) + energy_sum(o, kKinetic) + energy_sum(o, kPotential) -
           part_paid(o) * object_sums[o * kObjectSums + kVibrations];
}

// The rigid part of velocities, for momentum and angular momentum about the centre where the part began.
void rigid_velocity(uint o, dvec3 momentum, dvec3 angular, out dvec3 velocity, out dvec3 spin) {
    double mass = energy_sum(o, kMass);
    velocity = momentum / mass;
    spin = double(texelFetch(bodies, 5 * int(o) + 3).w) / mass * (dmat3(inverse_inertia_of(o)) * angular);
}
