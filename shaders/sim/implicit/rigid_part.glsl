// How a body moves as a rigid one, by its momentum and angular momentum.
// CPU twins: gelatin::cpu::RigidPart, RigidInertia.
#include "layouts/end_sums.glsl"

struct RigidPart {
    double inverse_mass;   // [1/kg]
    dvec3 center;          // of mass, from the body's centre where the part began [m]
    dmat3 inverse_inertia; // about it [1/(kg m^2)]
    dvec3 velocity, spin;  // of the centre [m/s]; [rad/s]
};

dvec3 triple(double s[kMotionSums], uint k) { return dvec3(s[k], s[k + 1u], s[k + 2u]); }

// A row of nodes, which does not resist a rotation about itself, gets a little.
dmat3 inverse_inertia(double mass, dvec3 center, dvec3 squares, dvec3 besides) {
    const double kThin = 1e-6LF;
    dvec3 s = squares - mass * center * center, b = mass * center.yzx * center.zxy - besides;
    double trace = s.x + s.y + s.z;
    if (!(trace > 0.0LF)) return dmat3(0.0LF);
    dvec3 d = (1.0LF + kThin) * dvec3(trace) - s;
    dvec3 x = dvec3(d.x, b.z, b.y), y = dvec3(b.z, d.y, b.x), z = dvec3(b.y, b.x, d.z);
    dvec3 first = cross(y, z);
    return (1.0LF / dot(x, first)) * dmat3(first, cross(z, x), cross(x, y));  // symmetric
}

// Adds sums of a body whose centre is at `arm`.
void add_body(inout double s[kMotionSums], double own[kMotionSums], dvec3 arm) {
    dvec3 arms = triple(own, kArm), momentum = triple(own, kMomentum);
    double mass = own[kMass];
    dvec3 square = 2.0LF * arms * arm + mass * arm * arm;
    dvec3 beside = arms.yzx * arm.zxy + arm.yzx * arms.zxy + mass * arm.yzx * arm.zxy;
    dvec3 moved = mass * arm, angular = cross(arm, momentum);
    for (uint k = 0u; k < kMotionSums; ++k) s[k] += own[k];
    for (int k = 0; k < 3; ++k) {
        s[kArm + uint(k)] += moved[k];
        s[kSquare + uint(k)] += square[k];
        s[kBeside + uint(k)] += beside[k];
        s[kAngular + uint(k)] += angular[k];
    }
}

// @param s of what is free
RigidPart rigid_part_of(double s[kMotionSums]) {
    RigidPart part;
    part.inverse_mass = 1.0LF / s[kMass];
    part.center = part.inverse_mass * triple(s, kArm);
    part.inverse_inertia = inverse_inertia(s[kMass], part.center, triple(s, kSquare), triple(s, kBeside));
    dvec3 momentum = triple(s, kMomentum);
    part.velocity = part.inverse_mass * momentum;
    part.spin = part.inverse_inertia * (triple(s, kAngular) - cross(part.center, momentum));
    return part;
}
