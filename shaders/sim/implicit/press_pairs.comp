// What presses two objects in a part, with rows of both directions; a work group a pair of the tables. Of two such pairs the one whose
// first object is the lesser has both.
// CPU twin: gelatin::cpu::Restitution::note. Parity: tests/gpu/implicit/part_end_test.cpp.
const uint kSums = 17u;  // kPairSums but for both objects
#include "sim/implicit/lane_sums.glsl"
#include "sim/implicit/pair_restitution.glsl"
#include "sim/implicit/rows.glsl"
#include "sim/implicit/row_sides.glsl"
#include "sim/implicit/solve_system.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer velocities;      // where the part ends [m/s]
uniform samplerBuffer displacements;   // d, xyz [m]
uniform usamplerBuffer pairs;            // StepPair
uniform usamplerBuffer row_chunks;       // first row, end
uniform usamplerBuffer coupling_starts;  // of each object, and the end
uniform usamplerBuffer couplings;        // 2 pair + side
layout(std430) readonly buffer Rows { StepRow rows[]; };
layout(std430) writeonly buffer PairPresses { double presses[]; };  // by pair

shared uint reverse;

bool is_free(uint o) { return texelFetch(bodies, 5 * int(o)).w > 0.0; }

uint first_row(uint p) { return texelFetch(row_chunks, int(texelFetch(pairs, int(p)).z)).x; }

// kNone: a plane
uvec2 objects_of(uint p) {
    StepRow row = rows[first_row(p)];
    uvec2 nodes = side_nodes(row);
    return uvec2(has_plane(row) ? kNone : object_of(nodes.x), object_of(nodes.y));
}

// The pair whose sides are these the other way round. In all invocations.
uint find_reverse(uint p, uvec2 objects) {
    uvec4 pair = texelFetch(pairs, int(p));
    int body = int(pair.x < object_count ? pair.x : pair.y);
    if (gl_LocalInvocationID.x == 0u) reverse = kNone;
    barrier();
    uint end = texelFetch(coupling_starts, body + 1).x;
    for (uint e = texelFetch(coupling_starts, body).x + gl_LocalInvocationID.x; e < end; e += 64u) {
        uint other = texelFetch(couplings, int(e)).x / 2u;
        if (objects_of(other) == objects.yx) atomicMin(reverse, other);
    }
    barrier();
    return reverse;
}

void add(inout double sums[kSums], uint k, vec3 value) {
    for (int i = 0; i < 3; ++i) sums[k - kPairForce + uint(i)] += double(value[i]);
}

// @param side 1: the pair's objects are in this order, -1: they are not
void add_rows(uint p, uvec2 objects, float side, inout double sums[kSums]) {
    uint end = texelFetch(row_chunks, int(texelFetch(pairs, int(p)).w) - 1).y;
    vec3 center = center_of(is_free(objects.y) ? objects.y : objects.x);
    bvec2 are_held = bvec2(!is_free(objects.x), !is_free(objects.y));
    for (uint r = first_row(p) + gl_LocalInvocationID.x; r < end; r += 64u) {
        StepRow row = rows[r];
        float force = pressing(row, relative(row, displacements));
        if (!(force > 0.0)) continue;
        uvec4 nodes = nodes_of(row);
        vec3 points[2] = vec3[2](vec3(0.0), vec3(0.0)), held = vec3(0.0);  // where the objects are
        for (int k = 0; k < 4; ++k) {
            float weight = row.weights[k];
            if (weight == 0.0) continue;
            int object = side * weight < 0.0 ? 0 : 1;
            points[object] += abs(weight) * texelFetch(positions, int(nodes[k])).xyz;
            if (are_held[object]) held += weight * texelFetch(velocities, int(nodes[k])).xyz;
        }
        vec3 pushed = side * force * row.normal.xyz;
        sums[0] += double(force);
        add(sums, kPairPushed, pushed);
        add(sums, kPairMoment, cross(points[1] - center_of(objects.y), pushed));
        add(sums, kPairOpposite, cross(points[0] - center_of(objects.x), pushed));
        add(sums, kPairArm, force * (points[side > 0.0 ? 1 : 0] - center));
        add(sums, kPairHeld, side * force * held);
        sums[kPairApart - kPairForce] += double(force * dot(row.normal.xyz, held));
    }
}

void main() {
    uint p = group_index(), lane = gl_LocalInvocationID.x;
    uvec2 objects = objects_of(p), wanted = uvec2(min(objects.x, objects.y), max(objects.x, objects.y));
    double sums[kSums];
    for (uint k = 0u; k < kSums; ++k) sums[k] = 0.0LF;
    if (wanted.x < wanted.y && wanted.y != kNone) {
        uint other = find_reverse(p, objects);
        bool is_mine = objects == wanted || other == kNone;
        if (is_mine && restitution_of(wanted) > 0.0 && (is_free(wanted.x) || is_free(wanted.y))) {
            add_rows(p, wanted, objects == wanted ? 1.0 : -1.0, sums);
            if (other != kNone) add_rows(other, wanted, objects == wanted ? -1.0 : 1.0, sums);
        }
    }
    for (uint k = 0u; k < kSums; ++k) put_sum(k, sums[k]);
    barrier();
    uint at = p * kPairSums;
    if (lane < kSums) presses[at + kPairForce + lane] = sum_of_lanes(lane);
    if (lane == 0u) {
        presses[at + kPairFirst] = double(wanted.x);
        presses[at + kPairSecond] = double(wanted.y);
    }
}
