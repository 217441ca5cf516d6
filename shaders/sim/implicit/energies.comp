// Energies of bodies and their motions as rigid ones, by chunk; a work group each, which has its share of the body's elements. KEEP:
// first free bodies get the momentum and angular momentum that what acts on them has made. STOP: nodes that the guard has moved are
// first stopped, where it has to. GUARDED: only where the guard has moved nodes.
// CPU twins: gelatin::cpu::EnergyAccount, TimeScheme::keep_momenta, ImplicitStep. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kSums = 22u;  // kEnergySums
#include "include/global_index.glsl"
#include "layouts/spring.glsl"
#include "layouts/step_end.glsl"
#include "layouts/step_state.glsl"
#include "sim/implicit/lane_sums.glsl"
#include "sim/implicit/rigid_part.glsl"
#include "sim/implicit/tets.glsl"
#include "sim/implicit/time_scheme.glsl"
#include "sim/implicit/elastic_energy.glsl"
#ifdef VOLUME
#include "sim/elasticity/volume_term.glsl"
#endif
layout(local_size_x = 64) in;

uniform usamplerBuffer chunks;        // object, first, count, origin
uniform usamplerBuffer chunk_starts;  // of each object, and the end
uniform samplerBuffer bodies;         // StepBody, five texels each
uniform uint chunk_count;
uniform samplerBuffer start_positions;  // where the part begins [m]
uniform usamplerBuffer springs;
uniform usamplerBuffer elements;        // of each object: first spring, springs, first tet, tets
uniform vec3 gravity;                   // [m/s^2]
layout(std430) writeonly buffer EnergySums { double energy_sums[]; };  // by chunk
#if defined(KEEP) || defined(STOP) || defined(GUARDED)
#include "sim/implicit/clock.glsl"
#endif
#if defined(KEEP) || defined(STOP)
layout(std430) buffer EndVelocities { vec4 end_velocities[]; };

vec4 velocity_at(uint n) { return end_velocities[n]; }
#else
uniform samplerBuffer velocities;  // [m/s]

vec4 velocity_at(uint n) { return texelFetch(velocities, int(n)); }
#endif

#ifdef KEEP
layout(std430) readonly buffer Paces { BodyPace paces[]; };
layout(std430) readonly buffer BodyEnergies { BodyEnergy energies[]; };
layout(std430) readonly buffer FinishSums { double finish_sums[]; };
shared double body_sums[kFinishSums];
RigidPart missing;

dvec3 of_body(uint k) { return dvec3(body_sums[k], body_sums[k + 1u], body_sums[k + 2u]); }

// What momentum and angular momentum lack, as a motion of the body; of what is free. In all invocations.
void prepare(uint object) {
    uint first = texelFetch(chunk_starts, int(object)).x, end = texelFetch(chunk_starts, int(object) + 1).x;
    for (uint k = gl_LocalInvocationID.x; k < kFinishSums; k += 64u) {
        double sum = 0.0LF;
        for (uint c = first; c < end; ++c) sum += finish_sums[c * kFinishSums + k];
        body_sums[k] = sum;
    }
    barrier();
    missing = RigidPart(0.0LF, dvec3(0.0LF), dmat3(0.0LF), dvec3(0.0LF), dvec3(0.0LF));
    if (!(texelFetch(bodies, 5 * int(object)).w > 0.0)) return;
    double motion[kMotionSums];
    for (uint k = 0u; k < kMotionSums; ++k) motion[k] = body_sums[k];
    missing = rigid_part_of(motion);
    BodyPace pace = paces[object];
    Scheme s = scheme_of(clock[0].step, energies[object].is_whole != 0u ? 0.0 : pace.past);
    dvec3 has = of_body(kMomentum), turns = of_body(kAngular) - cross(missing.center, has);
    dvec3 force = of_body(kForce), moment = of_body(kMoment) - cross(missing.center, force);
    force += dvec3(gravity) * motion[kMass];
    double h = double(s.size), past = double(s.past), alpha = double(s.alpha), gamma = double(s.gamma);
    dvec3 force_before = past * dvec3(pace.force.xyz), moment_before = past * dvec3(pace.moment.xyz);
    force = (force + alpha * force_before) / (1.0LF + alpha);
    moment = (moment + alpha * moment_before) / (1.0LF + alpha);
    dvec3 had = of_body(kStart), had_angular = of_body(kStart + 3u) - cross(missing.inverse_mass * of_body(kStart + 6u), had);
    dvec3 momentum = had + h * ((1.0LF - gamma) * force_before + gamma * force) - has;
    dvec3 angular = had_angular + h * ((1.0LF - gamma) * moment_before + gamma * moment) - turns;
    missing.velocity = missing.inverse_mass * momentum;
    missing.spin = missing.inverse_inertia * angular;
}

void change_velocity(uint n, dvec3 r) {
    end_velocities[n].xyz += vec3(missing.velocity + cross(missing.spin, r - missing.center));
}
#elif defined(STOP)
uniform samplerBuffer displacements;  // d [m]
layout(std430) readonly buffer BodyChanges { BodyChange changes[]; };
BodyChange change;

void prepare(uint object) { change = changes[object]; }

// Nodes are no faster than they went.
void change_velocity(uint n, dvec3 r) {
    vec3 place = texelFetch(positions, int(n)).xyz;
    vec3 wanted = texelFetch(start_positions, int(n)).xyz + texelFetch(displacements, int(n)).xyz;
    end_velocities[n].xyz +=
        (place - wanted) / clock[0].step + change.velocity.xyz + cross(change.spin.xyz, place - change.center.xyz);
}
#else
void prepare(uint object) {}
void change_velocity(uint n, dvec3 r) {}
#endif

#ifdef GUARDED
layout(std430) readonly buffer GuardSums { double guard_sums[]; };  // by chunk

bool has_to(uint object) {
    bool any = false;
    uint end = texelFetch(chunk_starts, int(object) + 1).x;
    for (uint c = texelFetch(chunk_starts, int(object)).x; c < end; ++c)
        any = any || guard_sums[c * kGuardSums + kHeldBack] > 0.0LF;
    return any;
}
#elif defined(STOP)
bool has_to(uint object) { return changes[object].action == 3u; }
#else
bool has_to(uint object) { return true; }
#endif

// Of `count` elements those that the k-th of `parts` chunks has.
uint share(uint count, uint k, uint parts) { return k * (count / parts) + min(k, count % parts); }

double elastic_energy(uint c, uvec4 chunk) {
    uint first = texelFetch(chunk_starts, int(chunk.x)).x, parts = texelFetch(chunk_starts, int(chunk.x) + 1).x - first;
    uint k = c - first, lane = gl_LocalInvocationID.x;
    uvec4 ranges = texelFetch(elements, int(chunk.x));
    double energy = 0.0LF;
    uint end = ranges.x + share(ranges.y, k + 1u, parts);
    for (uint s = ranges.x + share(ranges.y, k, parts) + lane; s < end; s += 64u) {
        uvec4 spring = texelFetch(springs, int(s));
        energy += spring_energy(Spring(spring.x, spring.y, uintBitsToFloat(spring.z), uintBitsToFloat(spring.w)));
    }
    end = ranges.z + share(ranges.w, k + 1u, parts);
    for (uint t = ranges.z + share(ranges.w, k, parts) + lane; t < end; t += 64u) energy += tet_energy(t);
#ifdef VOLUME
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec2 rest = texelFetch(node_volumes, int(n)).xy;
        energy += double(rest.x * rest.y * volume_potential(volume_ratio_round(n), rest.y));
    }
#endif
    return energy;
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    if (!has_to(chunk.x)) return;
    prepare(chunk.x);
    dvec3 center = dvec3(texelFetch(bodies, 5 * int(chunk.x)).xyz), turning = dvec3(0.0LF);
    double motion[kMotionSums], kinetic = 0.0LF, potential = 0.0LF;
    for (uint k = 0u; k < kMotionSums; ++k) motion[k] = 0.0LF;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 x = texelFetch(positions, int(n));
        if (!(x.w > 0.0)) continue;
        double m = 1.0LF / double(x.w);
        dvec3 r = dvec3(x.xyz) - center;
        change_velocity(n, r);
        dvec3 v = dvec3(velocity_at(n).xyz);
        add_node(m, r, v, motion);
        turning += m * cross(dvec3(texelFetch(start_positions, int(n)).xyz) - center, v);
        kinetic += 0.5LF * m * dot(v, v);
        potential -= m * dot(dvec3(gravity), dvec3(x.xyz));
    }
    put_motion(motion);
    put_sum(kElastic, elastic_energy(c, chunk));
    put_sum(kKinetic, kinetic);
    put_sum(kPotential, potential);
    put_sums(kTurning, turning);
    barrier();
    for (uint k = lane; k < kSums; k += 64u) energy_sums[c * kSums + k] = sum_of_lanes(k);
}
