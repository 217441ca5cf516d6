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
#include "sim/implicit/row_sides.glsl"
#include "sim/implicit/solve_system.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer velocities;     // where the part ends [m/s]
uniform samplerBuffer slips;          // of rows; w: limit of friction [N]
uniform usamplerBuffer entry_starts;  // of each node, and the end
uniform usamplerBuffer row_entries;   // 4 row + place of the node in it
uniform samplerBuffer colliders;      // Collider, four texels each
uniform uint collider_count;
uniform uint body_count;
uniform samplerBuffer rigid_velocities;  // of objects: BodyMotion, two texels each
layout(std430) readonly buffer Rows { StepRow rows[]; };
layout(std430) readonly buffer ElasticForces { vec4 elastic_forces[]; };  // where the part begins [N]
layout(std430) readonly buffer FinishSums { double finish_sums[]; };      // by chunk
layout(std430) writeonly buffer PartSums { double part_sums[]; };         // by chunk
layout(std430) writeonly buffer PressedSums { double pressed_sums[]; };   // by collider and chunk

// How a node moves with its object as a rigid one [m/s].
vec3 rigid_velocity(uint n, uint object) {
    BodyMotion motion =
        BodyMotion(texelFetch(rigid_velocities, 2 * int(object)), texelFetch(rigid_velocities, 2 * int(object) + 1));
    return at_node(motion, center_of(object), n);
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

// By held nodes and belts on what a contact presses, whose nearest points move by s [J].
float work_on_row(StepRow row, vec3 s, float limit, uvec2 sides) {
    uvec4 nodes = nodes_of(row);
    vec3 moved = vec3(0.0);  // as much as s by what is held
    for (int k = 0; k < 4; ++k)
        if (row.weights[k] != 0.0 && texelFetch(positions, int(nodes[k])).w == 0.0)
            moved += row.weights[k] * texelFetch(displacements, int(nodes[k])).xyz;
    vec3 belts = texelFetch(node_objects, int(sides.y)).xyz - texelFetch(node_objects, int(sides.x)).xyz;
    if (!has_plane(row)) moved += clock[0].step * belts;
    return moved != vec3(0.0) ? -dot(force_at(row, s, limit), moved) : 0.0;
}

// Of one side of a contact, at its first node. Each of two bodies has half of the energy.
void add_row(uint entry, inout double sums[kStartMomentum]) {
    uint r = entry / 4u;
    StepRow row = rows[r];
    if (!is_first_of_side(row, entry % 4u)) return;
    bool is_alone = has_plane(row), is_second = row.weights[entry % 4u] > 0.0;
    uvec2 sides = side_nodes(row), objects = uvec2(object_of(sides.x), object_of(sides.y));
    vec3 s = relative(row, displacements);
    float limit = texelFetch(slips, int(r)).w, force = pressing(row, s);
    bool are_bodies = !is_alone && max(objects.x, objects.y) < body_count;
    float share = are_bodies ? 0.5 : 1.0;
    sums[kContactsAtStart] += double(share * energy_at(row, vec3(0.0), limit));
    sums[kContactsAtEnd] += double(share * energy_at(row, s, limit));
    if (is_second == (objects.y < body_count)) sums[kWork] += double(work_on_row(row, s, limit, sides));
    uvec4 nodes = nodes_of(row);
    vec3 apart = vec3(0.0);
    for (int k = 0; k < 4; ++k)
        if (row.weights[k] != 0.0) apart += row.weights[k] * rigid_velocity(nodes[k], row.weights[k] < 0.0 ? objects.x : objects.y);
    sums[kPressing] += double(force);
    sums[kApproach] += double(force * abs(dot(row.normal.xyz, apart)));
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    vec3 center = center_of(chunk.x);
    double sums[kStartMomentum];
    for (uint k = 0u; k < kStartMomentum; ++k) sums[k] = 0.0LF;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 x = texelFetch(positions, int(n));
        vec3 v = texelFetch(velocities, int(n)).xyz, beside = v - rigid_velocity(n, chunk.x);
        sums[kWork] += double(work_on(n, x, texelFetch(displacements, int(n)).xyz));
        if (x.w > 0.0) sums[kSquares] += double(dot(beside, beside) / x.w);
        sums[kGreatestSpeed] = max(sums[kGreatestSpeed], double(length(v)));
        uint end = texelFetch(entry_starts, int(n) + 1).x;
        for (uint e = texelFetch(entry_starts, int(n)).x; e < end; ++e) add_row(texelFetch(row_entries, int(e)).x, sums);
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
                if (row.plane != p || !has_plane(row)) continue;
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
