// The rigid motions of bodies that balance their contacts, by Newton's method; a work group an island does all of it. The limits of
// friction stay as they are until bodies are nearly in balance (Tresca's friction).
// CPU twin: gelatin::cpu::RigidSolve::run. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "sim/implicit/island_lanes.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/line_search.glsl"
#include "sim/implicit/rigid_level.glsl"
#include "sim/implicit/rigid_bodies.glsl"
#include "sim/implicit/move_nodes.glsl"
layout(local_size_x = LANES) in;

uniform samplerBuffer base_sums;  // ResidualSums of chunks, two texels each: forces of all but rows
uniform float tolerance;          // forces that may be left on a body, as a part of what presses it
// Of each object and of one that never moves, one kind after the other.
layout(std430) coherent buffer Vectors { BodyMotion vectors[]; };
const uint kMotion = 0u, kBase = 1u, kForce = 2u, kStep = 3u, kDirection = 4u, kProduct = 5u, kPreconditioned = 6u;

#define FOR_BODIES(island) for (uint k = island.first_body + gl_LocalInvocationID.x; k < island.body_end; k += kLanes)
uint at(uint kind, uint object) { return kind * (object_count + 1u) + object; }
BodyMotion plus(BodyMotion a, float factor, BodyMotion b) {
    return BodyMotion(a.displacement + factor * b.displacement, a.rotation + factor * b.rotation);
}

RowStiffness row_stiffness(uint r) { return stiffness_at(rows[r], slips[r].xyz, slips[r].w); }

// Of its inertia.
BodyMotion resistance(uint object, BodyMotion motion) {
    vec4 d = texelFetch(bodies, 5 * int(object) + 3);
    vec3 b = texelFetch(bodies, 5 * int(object) + 4).xyz, w = motion.rotation.xyz;
    return BodyMotion(d.w * motion.displacement, vec4(d.xyz * w + b.zxy * w.yzx + b.yzx * w.zxy, 0.0));
}

// What is left on bodies, rows in it; w: what presses them.
void find_forces(StepIsland island) {
    wait_for_group();
    for (uint c = island.first_row_chunk + gl_LocalInvocationID.x; c < island.row_chunk_end; c += kLanes) {
        vec4 force = vec4(0.0);
        vec3 first = vec3(0.0), second = vec3(0.0);
        uvec2 range = texelFetch(row_chunks, int(c)).xy;
        for (uint r = range.x; r < range.y; ++r) {
            vec3 f = force_at(rows[r], slips[r].xyz, slips[r].w);
            force += vec4(f, pressing(rows[r], slips[r].xyz));
            first += cross(arm_at(r, 0u), f);
            second += cross(arm_at(r, 1u), f);
        }
        row_sums[c * kMatrixSums] = force;
        row_sums[c * kMatrixSums + 1u] = vec4(first, 0.0);
        row_sums[c * kMatrixSums + 2u] = vec4(second, 0.0);
    }
    sum_by_pair(island, 3u, kMatrixSums);
    FOR_BODIES(island) vectors[at(kForce, body(k))] = plus(vectors[at(kBase, body(k))], 1.0, sum_of_pairs(body(k)));
}

bool is_balanced(StepIsland island, float part) {
    float unbalanced = 0.0;
    FOR_BODIES(island) {
        vec4 force = vectors[at(kForce, body(k))].displacement;
        float weight = texelFetch(bodies, 5 * int(body(k)) + 2).w, presses = force.w;
        float scale = weight > 0.0 ? min(presses, 2.0 * weight) + 0.05 * presses : presses;
        bool is_free = texelFetch(bodies, 5 * int(body(k))).w > 0.0;
        if (is_free && presses > 0.0 && length(force.xyz) > part * scale) unbalanced += 1.0;
    }
    return !(sum_over_group(unbalanced) > 0.0);
}

// What pairs resist directions with.
void multiply_pairs(StepIsland island) {
    wait_for_group();
    for (uint p = island.first_pair + gl_LocalInvocationID.x; p < island.pair_end; p += kLanes) {
        uvec4 pair = texelFetch(pairs, int(p));
        BodyMotion first = vectors[at(kDirection, pair.x)], second = vectors[at(kDirection, pair.y)];
        vec3 d = second.displacement.xyz - first.displacement.xyz, v = first.rotation.xyz, w = second.rotation.xyz;
        mat3 by_first = pair_matrix(p, 1u), by_second = pair_matrix(p, 2u), across = pair_matrix(p, 5u);
        uint to = p * kPairSums + kMatrixSums;
        pair_sums[to] = vec4(pair_matrix(p, 0u) * d + by_second * w - by_first * v, 0.0);
        pair_sums[to + 1u] = vec4(d * by_first + across * w - pair_matrix(p, 3u) * v, 0.0);
        pair_sums[to + 2u] = vec4(d * by_second + pair_matrix(p, 4u) * w - v * across, 0.0);
    }
    wait_for_group();
}

// z = E_b^-1 r @return r . z
float precondition(uint object) {
    BodyMotion force = vectors[at(kForce, object)], z = times(body_inverses[object], force);
    vectors[at(kPreconditioned, object)] = z;
    return dot_of(force, z);
}

// E^-1 of the forces, by conjugate gradients.
void find_step(StepIsland island) {
    FOR_BODIES(island) vectors[at(kStep, body(k))] = BodyMotion(vec4(0.0), vec4(0.0));
    float before = 0.0, enough = 0.0;
    for (uint iteration = 0u; iteration <= kMostRigidIterations; ++iteration) {
        float sum = 0.0;
        FOR_BODIES(island) sum += precondition(body(k));
        float rz = sum_over_group(sum);
        if (iteration == 0u) enough = kRigidForcing * rz;
        if (!(rz > enough) || iteration == kMostRigidIterations) break;
        FOR_BODIES(island) {
            uint o = body(k);
            BodyMotion z = vectors[at(kPreconditioned, o)];
            vectors[at(kDirection, o)] = iteration == 0u ? z : plus(z, rz / before, vectors[at(kDirection, o)]);
        }
        before = rz;
        multiply_pairs(island);
        sum = 0.0;
        FOR_BODIES(island) {
            uint o = body(k);
            BodyMotion p = vectors[at(kDirection, o)], product = plus(resistance(o, p), 1.0, sum_of_pairs(o));
            vectors[at(kProduct, o)] = product;
            sum += dot_of(p, product);
        }
        float curvature = sum_over_group(sum);
        if (!(curvature > 0.0)) break;
        FOR_BODIES(island) {
            uint o = body(k);
            vectors[at(kStep, o)] = plus(vectors[at(kStep, o)], rz / curvature, vectors[at(kDirection, o)]);
            vectors[at(kForce, o)] = plus(vectors[at(kForce, o)], -rz / curvature, vectors[at(kProduct, o)]);
        }
    }
    wait_for_group();
}

vec3 displaced(BodyMotion motion, vec3 arm) { return motion.displacement.xyz + cross(motion.rotation.xyz, arm); }

vec3 change_of(uint r) {
    return displaced(vectors[at(kStep, rows[r].other)], arm_at(r, 1u)) -
           displaced(vectors[at(kStep, rows[r].object)], arm_at(r, 0u));
}

// As far along it as the objective falls.
void make_step(StepIsland island) {
    vec4 sums = vec4(0.0);
    FOR_BODIES(island) {
        BodyMotion step = vectors[at(kStep, body(k))];
        sums.x += dot_of(step, vectors[at(kBase, body(k))]);
        sums.y += dot_of(step, resistance(body(k), step));
    }
    sums = sum_over_group(sums);
    float part = line_search(island, sums.x, sums.y);
    FOR_BODIES(island) {
        BodyMotion step = vectors[at(kStep, body(k))];
        vectors[at(kMotion, body(k))] = plus(vectors[at(kMotion, body(k))], part, step);
        vectors[at(kBase, body(k))] = plus(vectors[at(kBase, body(k))], -part, resistance(body(k), step));
    }
    for (uint r = island.first_row + gl_LocalInvocationID.x; r < island.row_end; r += kLanes)
        slips[r].xyz += part * change_of(r);
}

// @return whether any moves as a rigid one
bool begin_bodies(StepIsland island) {
    float free = 0.0;
    FOR_BODIES(island) {
        uint o = body(k);
        BodyMotion base = BodyMotion(vec4(0.0), vec4(0.0));
        uint end = texelFetch(chunk_starts, int(o) + 1).x;
        for (uint c = texelFetch(chunk_starts, int(o)).x; c < end; ++c) {
            base.displacement.xyz += texelFetch(base_sums, 2 * int(c)).xyz;
            base.rotation += texelFetch(base_sums, 2 * int(c) + 1);
        }
        vectors[at(kBase, o)] = base;
        vectors[at(kMotion, o)] = BodyMotion(vec4(0.0), vec4(0.0));
        if (texelFetch(bodies, 5 * int(o)).w > 0.0) free += 1.0;
    }
    return sum_over_group(free) > 0.0;
}

void set_limits(StepIsland island) {
    for (uint r = island.first_row + gl_LocalInvocationID.x; r < island.row_end; r += kLanes)
        slips[r].w = rows[r].friction * pressing(rows[r], slips[r].xyz);
}

void balance(StepIsland island) {
    for (uint round_ = 0u; round_ < kMostRounds; ++round_) {
        // Twice where limits of friction change between; one loop, so that it is compiled once.
        bool is_near = false;
        for (uint k = 0u; k < 2u; ++k) {
            find_forces(island);
            bool is_done = is_balanced(island, is_near ? tolerance : kNearly);
            if (is_near && is_done && round_ > 0u) return;
            if (is_near || !is_done) break;
            set_limits(island);
            is_near = true;
        }
        find_matrix(island);
        find_step(island);
        make_step(island);
    }
}

void main() {
    uint i = group_index();
    if (i >= object_count) return;
    StepIsland island = fetch_island(i);
    if (!begin_bodies(island) || !has_rows(island)) return;
    balance(island);
    if (!is_small(island)) return;  // move_bodies.comp moves its nodes
    wait_for_group();
    for (uint k = island.first_chunk; k < island.chunk_end; ++k) {
        uvec4 chunk = texelFetch(chunks, int(texelFetch(island_chunks, int(k)).x));
        move_nodes(chunk, vectors[at(kMotion, chunk.x)]);
    }
}
