// What a part has done, by chunk, a work group each: energy of contacts where it began and ends, work of loads, hands and held nodes;
// how fast bodies move beside what they touch; and what presses them on colliders with restitution.
// CPU twins: gelatin::cpu::EnergyAccount, Paces::find, Restitution. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kSums = 10u;  // kPressedSums; of kPartSums fewer are summed here
#define PRODUCTS
#include "sim/implicit/clock.glsl"
#include "sim/drive/load_force.glsl"
#include "sim/drive/pull.glsl"
#include "sim/implicit/lane_sums.glsl"
#include "sim/implicit/half_edges.glsl"
#include "sim/implicit/rows.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/inverse_inertia.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer velocities;     // where the part ends [m/s]
uniform samplerBuffer slips;          // of rows; w: limit of friction [N]
uniform usamplerBuffer entry_starts;  // of each node, and the end
uniform usamplerBuffer row_entries;   // 4 row + place of the node in it
uniform samplerBuffer colliders;      // Collider, four texels each
uniform uint collider_count;
layout(std430) readonly buffer Paces { BodyPace paces[]; };
layout(std430) readonly buffer Rows { StepRow rows[]; };
layout(std430) readonly buffer ElasticForces { vec4 elastic_forces[]; };  // where the part begins [N]
layout(std430) readonly buffer FinishSums { double finish_sums[]; };      // by chunk
layout(std430) readonly buffer EnergySums { double energy_sums[]; };      // by chunk
layout(std430) writeonly buffer PartSums { double part_sums[]; };         // by chunk
layout(std430) writeonly buffer PressedSums { double pressed_sums[]; };   // by collider and chunk

shared double body_sums[6];  // momentum, angular momentum

// The rigid part of the velocities of a free body, with the arms where the part began [m/s], [rad/s].
BodyMotion rigid_velocity(uint object) {
    uint lane = gl_LocalInvocationID.x, end = texelFetch(chunk_starts, int(object) + 1).x;
    if (lane < 6u) {
        uint k = lane < 3u ? kMomentum + lane : kTurning + lane - 3u;
        double sum = 0.0LF;
        for (uint c = texelFetch(chunk_starts, int(object)).x; c < end; ++c) sum += energy_sums[c * kEnergySums + k];
        body_sums[lane] = sum;
    }
    barrier();
    if (!(texelFetch(bodies, 5 * int(object)).w > 0.0)) return BodyMotion(vec4(0.0), vec4(0.0));
    vec3 momentum = vec3(body_sums[0], body_sums[1], body_sums[2]), angular = vec3(body_sums[3], body_sums[4], body_sums[5]);
    float mass = paces[object].velocity.w, weight = texelFetch(bodies, 5 * int(object) + 3).w / mass;
    return BodyMotion(vec4(momentum / mass, 0.0), vec4(weight * (inverse_inertia_of(object) * angular), 0.0));
}

// On a node where the part begins and its displacement d [J].
float work_on(uint n, vec4 x, vec3 d) {
    float work = 0.0;
#ifdef LOADED
    work += dot(load_force(n), d);
#endif
    if (x.w == 0.0 && d != vec3(0.0)) work -= dot(elastic_forces[n].xyz - stiffness_times(n, d), d);
    if (is_pulled != 0u) {
        float h = clock[0].step;
        work += max(max(dot(pull_force_at_end(n, x.xyz, x.xyz, h), d), dot(pull_force_at_end(n, x.xyz + d, x.xyz, h), d)), 0.0);
    }
    return work;
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count || !goes_on()) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    vec3 center = center_of(chunk.x);
    BodyMotion rigid = rigid_velocity(chunk.x);
    double sums[kStartMomentum];
    for (uint k = 0u; k < kStartMomentum; ++k) sums[k] = 0.0LF;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 x = texelFetch(positions, int(n));
        vec3 v = texelFetch(velocities, int(n)).xyz, moves = at_node(rigid, center, n), beside = v - moves;
        sums[kWork] += double(work_on(n, x, texelFetch(displacements, int(n)).xyz));
        if (x.w > 0.0) sums[kSquares] += double(dot(beside, beside) / x.w);
        sums[kGreatestSpeed] = max(sums[kGreatestSpeed], double(length(v)));
        uint end = texelFetch(entry_starts, int(n) + 1).x;
        for (uint e = texelFetch(entry_starts, int(n)).x; e < end; ++e) {
            uint r = texelFetch(row_entries, int(e)).x / 4u;
            StepRow row = rows[r];
            vec3 s = relative(row, displacements);
            float limit = texelFetch(slips, int(r)).w, force = pressing(row, s);
            sums[kContactsAtStart] += double(energy_at(row, vec3(0.0), limit));
            sums[kContactsAtEnd] += double(energy_at(row, s, limit));
            sums[kPressing] += double(force);
            sums[kApproach] += double(force * abs(dot(row.normal.xyz, moves)));
        }
    }
    for (uint k = 0u; k < kStartMomentum; ++k) put_sum(k, sums[k]);
    barrier();
    if (lane < kGreatestSpeed) part_sums[c * kPartSums + lane] = sum_of_lanes(lane);
    if (lane == kGreatestSpeed) part_sums[c * kPartSums + lane] = most_of_lanes(lane);
    if (kStartMomentum + lane < kPartSums)
        part_sums[c * kPartSums + kStartMomentum + lane] = finish_sums[c * kFinishSums + kStart + lane];
    for (uint p = 0u; p < collider_count; ++p) {
        if (!(texelFetch(colliders, 4 * int(p) + 3).z > 0.0)) continue;
        float pressed = 0.0;
        vec3 pushed = vec3(0.0), moment = vec3(0.0), arms = vec3(0.0);
        for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
            uint end = texelFetch(entry_starts, int(n) + 1).x;
            for (uint e = texelFetch(entry_starts, int(n)).x; e < end; ++e) {
                StepRow row = rows[texelFetch(row_entries, int(e)).x / 4u];
                if (row.plane != p) continue;
                float force = pressing(row, relative(row, displacements));
                vec3 arm = texelFetch(positions, int(n)).xyz - center;
                pressed += force;
                pushed += force * row.normal.xyz;
                moment += cross(arm, force * row.normal.xyz);
                arms += force * arm;
            }
        }
        barrier();  // whoever still reads the sums before
        put_sum(kPressed, double(pressed));
        put_sums(kPressedForce, dvec3(pushed));
        put_sums(kPressedMoment, dvec3(moment));
        put_sums(kPressedArm, dvec3(arms));
        barrier();
        if (lane < kPressedSums) pressed_sums[(p * chunk_count + c) * kPressedSums + lane] = sum_of_lanes(lane);
    }
}
