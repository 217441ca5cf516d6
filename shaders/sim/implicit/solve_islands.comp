// Small islands are solved, each by a work group: linearisations, conjugate gradients and line searches are loops in it. An invocation
// has a node of each chunk; what others read of it is in shared memory. An island without bodies has made no iterations.
// CPU twin: gelatin::cpu::IslandSolve. Parity: tests/gpu/implicit/step_system_test.cpp.
const uint kLanes = 256u;
#define PRODUCTS
#define MAKES_TANGENTS
#define FIELD_AT(n) value_at((n) + to_slot)
#include "layouts/packing.glsl"
layout(local_size_x = 256) in;

const uint kMost = kChunksOfSmallIsland, kSlots = kLanes * kMost;
shared float values[3u * kSlots];  // d, p or the step: what others read of nodes [m]
uint to_slot;                      // from a node of the body of the chunk that is worked on

vec3 value_at(uint slot) { return vec3(values[slot], values[slot + kSlots], values[slot + 2u * kSlots]); }

void set_value(uint slot, vec3 value) {
    values[slot] = value.x;
    values[slot + kSlots] = value.y;
    values[slot + 2u * kSlots] = value.z;
}

layout(std430) coherent buffer Displacements { vec4 displacements[]; };  // d [m]

#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/solve_state.glsl"
#include "sim/implicit/group_residuals.glsl"
#include "sim/implicit/node_system.glsl"
#ifdef ROWS
#include "sim/implicit/line_search.glsl"
#include "sim/implicit/row_arms.glsl"
#include "sim/implicit/row_tangents.glsl"
layout(std430) writeonly buffer BaseSums { ResidualSums base_sums[]; };
#endif
layout(std430) writeonly buffer States { SolveState states[]; };

shared uvec4 island_parts[kMost];       // chunks: object, first node, count, which body of the island
shared ResidualSums part_sums[kMost];   // of chunks
shared uint objects[kMost];             // of bodies
shared BodyInverse body_inverses[kMost];
shared BodyMotion body_forces[kMost], body_motions[kMost];  // W^T r, and the rigid motion by it
shared vec2 body_lacks[kMost];
StepIsland island;
uint part_count, body_count;  // of chunks, of bodies
// Of the invocation's node in each chunk.
vec3 steps[kMost];        // [m]
vec3 bases[kMost];        // loads - A d, without rows [N]
vec3 residuals[kMost];    // r [N]
vec3 products[kMost];     // A p, then A times the step without rows [N]
vec3 corrections[kMost];  // z without the rigid motion [m]
NodeTerms blocks[kMost];

#define FOR_PARTS(k) for (uint k = 0u; k < part_count; ++k)
uint slot_of(uint k) { return k * kLanes + gl_LocalInvocationID.x; }
// kNone: there is none.
uint node_of(uint k) {
    to_slot = k * kLanes - island_parts[k].y;
    return gl_LocalInvocationID.x < island_parts[k].z ? island_parts[k].y + gl_LocalInvocationID.x : kNone;
}
// m / h^2 [N/m]; 0 where a node is held, or there is none.
float inertia_of(uint n) { return n == kNone ? 0.0 : texelFetch(loads, int(n)).w; }

#ifdef ROWS
uint body(uint k) { return objects[k - island.first_body]; }
void keep_inverse(uint k, BodyInverse inverse_) { body_inverses[k - island.first_body] = inverse_; }
vec3 arm_at(uint r, uint side) { return arm_of(rows[r], side == 0u ? rows[r].object : rows[r].other, side == 0u); }

// 0 on what belongs to no body of the island: it does not move.
vec3 relative(StepRow row) {
    uvec4 nodes = nodes_of(row);
    vec3 s = vec3(0.0);
    for (int j = 0; j < 4; ++j)
        FOR_PARTS(k) {
            uint place = nodes[j] - island_parts[k].y;
            if (place < island_parts[k].z) s += row.weights[j] * value_at(k * kLanes + place);
        }
    return s;
}

vec3 change_of(uint r) { return relative(rows[r]); }

// By the displacements in memory.
vec3 displaced(StepRow row) {
    uvec4 nodes = nodes_of(row);
    vec3 s = vec3(0.0);
    for (int j = 0; j < 4; ++j) s += row.weights[j] * displacements[nodes[j]].xyz;
    return s;
}

// What rows exert at their slips, and by how much less after the displacements that are shared.
bool has_slips, has_values;
vec3 row_value(uint r, StepRow row) {
    vec3 s = vec3(0.0);
    if (has_values) s = relative(row);
    if (!has_slips) return times(row_stiffness(r), s);
    return tangents[r].constant.xyz - times(row_stiffness(r), slips[r].xyz + s);
}
void choose(bool slips_too, bool values_too) {
    has_slips = slips_too;
    has_values = values_too;
}
#endif

// Of a chunk; of what is no node the force is 0.
void sum_part(uint k, uint n, vec3 force, float product) {
    vec3 moment = vec3(0.0);
    if (n != kNone) moment = cross(texelFetch(positions, int(n)).xyz - center_of(island_parts[k].x), force);
    ResidualSums sum = sum_by_lanes(vec4(force, product), moment);
    if (gl_LocalInvocationID.x == 0u) part_sums[k] = sum;
}

void begin() {
    uint lane = gl_LocalInvocationID.x;
    part_count = island.chunk_end - island.first_chunk;
    body_count = island.body_end - island.first_body;
    if (lane == 0u) {
        uint b = 0u;
        FOR_PARTS(k) {
            uvec4 chunk = texelFetch(chunks, int(texelFetch(island_chunks, int(island.first_chunk + k)).x));
            if (k > 0u && chunk.x != objects[b]) ++b;
            objects[b] = chunk.x;
            island_parts[k] = uvec4(chunk.xyz, b);
        }
    }
    barrier();
#ifndef ROWS
    if (lane < body_count) body_inverses[lane] = fetch_inverse(objects[lane]);
#endif
    FOR_PARTS(k) {
        uint n = node_of(k);
        set_value(slot_of(k), n == kNone ? vec3(0.0) : displacements[n].xyz);
    }
    barrier();
}

// What bodies lack, and their rigid motions. @param lacks r . z of chunks @param a how much of A p is taken from r
vec2 find_motions(bool is_first, vec4 lacks, float a) {
    uint b = gl_LocalInvocationID.x;
    barrier();
    if (b < body_count) {
        BodyMotion change = BodyMotion(vec4(0.0), vec4(0.0));
        float lack = 0.0;
        FOR_PARTS(k) if (island_parts[k].w == b) {
            change.displacement.xyz += part_sums[k].force.xyz;
            change.rotation += part_sums[k].moment;
            lack += is_first ? part_sums[k].force.w : lacks[k];
        }
        BodyMotion force = change;
        if (!is_first)
            force = BodyMotion(body_forces[b].displacement - a * change.displacement, body_forces[b].rotation - a * change.rotation);
        BodyMotion motion = times(body_inverses[b], force);
        body_forces[b] = force;
        body_motions[b] = motion;
        body_lacks[b] = lack_of(objects[b], lack + dot_of(force, motion));
    }
    barrier();
    vec2 total = vec2(0.0);
    for (uint k = 0u; k < body_count; ++k) total += body_lacks[k];
    return total;
}

// From no step: r, blocks and z.
void find_residuals(bool is_first) {
    FOR_PARTS(k) {
        uint n = node_of(k);
        steps[k] = residuals[k] = corrections[k] = vec3(0.0);
        if (inertia_of(n) > 0.0) {
            vec4 load = texelFetch(loads, int(n));
            if (is_first) bases[k] = base_of(n, load, value_at(slot_of(k)));
            residuals[k] = bases[k] + sum_of_rows(n);
            blocks[k] = block_at(n, load.w);
            corrections[k] = solve(blocks[k], residuals[k]);
        } else if (is_first) {
            bases[k] = vec3(0.0);
        }
        sum_part(k, n, residuals[k], dot(residuals[k], corrections[k]));
    }
}

// p = z + b p. Not before all have read p.
void find_direction(float b) {
    FOR_PARTS(k) {
        uint n = node_of(k), slot = slot_of(k);
        vec3 p = vec3(0.0);
        if (inertia_of(n) > 0.0) {
            p = corrections[k] + at_node(body_motions[island_parts[k].w], center_of(island_parts[k].x), n);
            if (b != 0.0) p += b * value_at(slot);
        }
        set_value(slot, p);
    }
    barrier();
}

// A p. @return p . A p
float multiply() {
    FOR_PARTS(k) {
        uint n = node_of(k);
        float inertia = inertia_of(n);
        vec3 p = value_at(slot_of(k));
        products[k] = vec3(0.0);
        if (inertia > 0.0) products[k] = product_at(n, inertia, p);
        sum_part(k, n, products[k], dot(p, products[k]));
    }
    barrier();
    float curvature = 0.0;
    FOR_PARTS(k) curvature += part_sums[k].force.w;
    return curvature;
}

// By a along p. @return r . z of each chunk, without rigid motions
vec4 make_iteration(float a) {
    vec4 own = vec4(0.0);
    FOR_PARTS(k) {
        if (!(inertia_of(node_of(k)) > 0.0)) continue;
        steps[k] += a * value_at(slot_of(k));
        residuals[k] -= a * products[k];
        corrections[k] = solve(blocks[k], residuals[k]);
        own[k] = dot(residuals[k], corrections[k]);
    }
    return sum_over_group(own);
}

SolveState conjugate_gradients(SolveState state) {
    bool with_rows = has_rows(island);
    state = first_state(state, find_motions(true, vec4(0.0), 0.0), with_rows);
    float b = 0.0;
    while (state.is_done == 0u) {
        find_direction(b);
#ifdef ROWS
        choose(false, true);
#endif
        float curvature = multiply(), a = 0.0;
        if (curvature > 0.0)
            a = state.lack / curvature;
        else
            state.is_stuck = 1u;
        float before = state.lack;
        vec4 lacks = make_iteration(a);
        state = next_state(state, find_motions(false, lacks, a), with_rows);
        b = state.lack / before;
    }
    return state;
}

// As far along the step as the objective falls; d is shared then.
void make_step() {
    float part = 1.0;
#ifdef ROWS
    if (has_rows(island)) {
        FOR_PARTS(k) set_value(slot_of(k), steps[k]);
        barrier();
        choose(true, true);
        vec2 own = vec2(0.0);
        FOR_PARTS(k) {
            uint n = node_of(k);
            // A times the step, without rows: what the residual lost, less what rows did.
            products[k] = vec3(0.0);
            if (inertia_of(n) > 0.0) products[k] = bases[k] + sum_of_rows(n) - residuals[k];
            own += vec2(dot(steps[k], bases[k]), dot(steps[k], products[k]));
        }
        vec2 sums = sum_over_group(vec4(own, 0.0, 0.0)).xy;
        part = line_search(island, sums.x, sums.y);
    }
#endif
    FOR_PARTS(k) {
        uint n = node_of(k);
        if (n == kNone) continue;
        displacements[n].xyz += part * steps[k];
        set_value(slot_of(k), displacements[n].xyz);
        bases[k] -= part * products[k];
    }
#ifdef ROWS
    // With held nodes that are not of the island. Rows of a body with itself have not followed its rigid motion so far.
    wait_for_group();
    for (uint r = island.first_row + gl_LocalInvocationID.x; r < island.row_end; r += kLanes) slips[r].xyz = displaced(rows[r]);
#else
    barrier();
#endif
}

SolveState solve_island() {
    SolveState state = SolveState(0.0, 0u, 0u, 0u, 0u, 0.0, 0u, 0u);
    begin();
    uint most = has_rows(island) ? kMostLinearisations : 1u;
    for (uint k = 0u; k < most; ++k) {
#ifdef ROWS
        linearise(island, k == 0u);
        choose(true, false);
#endif
        find_residuals(k == 0u);
        state = conjugate_gradients(state);
        if (state.made == 0u) break;
        make_step();
    }
#ifdef ROWS
    if (has_rows(island))
        FOR_PARTS(k) {
            sum_part(k, node_of(k), bases[k], 0.0);
            if (gl_LocalInvocationID.x == 0u) base_sums[texelFetch(island_chunks, int(island.first_chunk + k)).x] = part_sums[k];
        }
#endif
    return state;
}

void main() {
    uint i = group_index();
    if (i >= object_count) return;
    island = fetch_island(i);
    bool has_bodies = island.first_chunk < island.chunk_end;
    if (has_bodies && !is_small(island)) return;
    SolveState state = SolveState(0.0, 0u, 0u, 0u, 0u, 0.0, 0u, 0u);
    if (has_bodies) state = solve_island();
    if (gl_LocalInvocationID.x == 0u) states[i] = state;
}
