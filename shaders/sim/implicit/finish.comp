// Where nodes are when a part ends, and how fast: rigid motions of free bodies become true rotations, to first order bodies would
// grow. What contacts with planes pass on; what acts on free bodies and how they move, by chunk. A work group a chunk.
// CPU twins: gelatin::cpu::RigidLevel::rotate, TimeScheme::velocity, ContactRows::note. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kSums = 36u;  // kFinishSums
#include "sim/drive/load_force.glsl"
#include "sim/drive/pull.glsl"
#include "sim/implicit/lane_sums.glsl"
#include "sim/implicit/rows.glsl"
#include "sim/implicit/row_sides.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/body_sums.glsl"
#include "sim/implicit/inverse_inertia.glsl"
#include "sim/implicit/sum_of_motions.glsl"
#include "sim/implicit/time_scheme.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer velocities;     // where the part begins [m/s]; w: damping time [s]
uniform samplerBuffer accelerations;  // a_0 [m/s^2]
uniform samplerBuffer slips;          // s of rows [m]; w: limit of friction [N]
uniform usamplerBuffer entry_starts;  // of each node, and the end
uniform usamplerBuffer row_entries;   // 4 row + place of the node in it
uniform vec3 gravity;                 // [m/s^2]
uniform uint body_node_count;
layout(std430) readonly buffer Paces { BodyPace paces[]; };
layout(std430) readonly buffer Rows { StepRow rows[]; };
layout(std430) buffer Displacements { vec4 displacements[]; };  // d [m]
layout(std430) writeonly buffer EndPositions { vec4 end_positions[]; };
layout(std430) writeonly buffer EndVelocities { vec4 end_velocities[]; };
layout(std430) writeonly buffer PlaneNotes { PlaneMemory notes[]; };
layout(std430) writeonly buffer FinishSums { double finish_sums[]; };  // by chunk

// Of free bodies.
BodyMotion rigid_motion(uint object) {
    ResidualSums sum = sum_of_motions(object);
    return BodyMotion(texelFetch(bodies, 5 * int(object)).w * sum.force, vec4(inverse_inertia_of(object) * sum.moment.xyz, 0.0));
}

// What the displacement at r differs by if the rotation w is a true one: of (sin t / t - 1) and (1 - cos t) / t^2 nothing cancels, and
// drivers' sines are less exact.
vec3 by_true_rotation(BodyMotion motion, vec3 r, vec3 d) {
    vec3 w = motion.rotation.xyz, turned = cross(w, r), rest = d - motion.displacement.xyz - turned;
    float t = dot(w, w), lack = 0.0, across = 1.0;
    if (t < 10.0) {
        for (float k = 16.0; k > 1.0; k -= 2.0) {
            lack = -t / (k * (k + 1.0)) * (1.0 + lack);
            across = k > 2.0 ? 1.0 - t / (k * (k - 1.0)) * across : 0.5 * across;
        }
    } else {
        lack = sin(sqrt(t)) / sqrt(t) - 1.0;
        across = (1.0 - cos(sqrt(t))) / t;
    }
    return lack * turned + across * cross(w, turned) + (1.0 + lack) * cross(w, rest) + across * cross(w, cross(w, rest));
}

// Of a contact with a plane; count_rows.comp has noted where there are none.
void note(uint n, StepRow row, vec3 s) {
    float limit = row.friction * pressing(row, s);
    vec3 hold = limit > 0.0 ? held_at(row, s, limit) : vec3(0.0);
    notes[row.plane * body_node_count + n] = PlaneMemory(vec4(hold, limit), row.reach, row.ease, 0.0, 0.0);
}

// On a node, by all but elements and gravity [N]. What a body exerts on itself cancels, also where both sides are apart.
vec3 force_on(uint n, vec3 x, vec3 d) {
    vec3 force = vec3(0.0);
#ifdef LOADED
    force += load_force(n);
#endif
    if (is_pulled != 0u) force += pull_force_at_end(n, x + d, x, clock[0].step);
    uint end = texelFetch(entry_starts, int(n) + 1).x;
    for (uint e = texelFetch(entry_starts, int(n)).x; e < end; ++e) {
        uint entry = texelFetch(row_entries, int(e)).x;
        StepRow row = rows[entry / 4u];
        vec4 slip = texelFetch(slips, int(entry / 4u));
        if (row.object != row.other) force += row.weights[entry % 4u] * force_at(row, slip.xyz, slip.w);
        if (has_plane(row)) note(n, row, slip.xyz);
    }
    return force;
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    bool is_free = texelFetch(bodies, 5 * int(chunk.x)).w > 0.0;
    vec3 center = center_of(chunk.x);
    BodyMotion rigid = rigid_motion(chunk.x);
    Scheme scheme = scheme_of(clock[0].step, paces[chunk.x].past);
    double motion[kMotionSums];
    for (uint k = 0u; k < kMotionSums; ++k) motion[k] = 0.0LF;
    dvec3 forces = dvec3(0.0LF), moments = dvec3(0.0LF), moved = dvec3(0.0LF), momentum = dvec3(0.0LF), angular = dvec3(0.0LF),
          arms = dvec3(0.0LF);
    double kinetic = 0.0LF, potential = 0.0LF;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 x = texelFetch(positions, int(n)), v = texelFetch(velocities, int(n));
        vec3 d = displacements[n].xyz, force = force_on(n, x.xyz, d);
        if (is_free) d += by_true_rotation(rigid, x.xyz - center, d);
        displacements[n] = vec4(d, 0.0);
        vec3 end = x.xyz + d;
        dvec3 start = dvec3(x.xyz) - dvec3(center), before = dvec3(v.xyz);
        if (x.w > 0.0) v.xyz = velocity_by(scheme, v.xyz, texelFetch(accelerations, int(n)).xyz, d);
        end_positions[n] = vec4(end, x.w);
        end_velocities[n] = v;
        if (!(x.w > 0.0)) continue;
        double m = 1.0LF / double(x.w);
        dvec3 r = dvec3(end) - dvec3(center);
        add_node(m, r, dvec3(v.xyz), motion);
        forces += dvec3(force);
        moments += cross(r, dvec3(force));
        moved += m * dvec3(d);
        momentum += m * before;
        angular += m * cross(start, before);
        arms += m * start;
        kinetic += 0.5LF * m * dot(before, before);
        potential -= m * dot(dvec3(gravity), dvec3(x.xyz));
    }
    put_motion(motion);
    put_sums(kForce, forces);
    put_sums(kMoment, moments);
    put_sums(kMoved, moved);
    put_sums(kStart, momentum);
    put_sums(kStart + 3u, angular);
    put_sums(kStart + 6u, arms);
    put_sum(kStart + 9u, kinetic);
    put_sum(kStart + 10u, potential);
    barrier();
    for (uint k = lane; k < kSums; k += 64u) finish_sums[c * kSums + k] = sum_of_lanes(k);
}
