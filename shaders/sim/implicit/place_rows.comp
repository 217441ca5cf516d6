// Whether the part is short enough for what its bodies touch; if so, by which scheme each body goes on, and where rows and their
// tables go. Bodies have rows with planes alone: each is an island by itself, all of its rows are one pair. One work group.
// CPU twin: gelatin::cpu::ImplicitStep::run, gelatin::cpu::Paces. Parity: tests/gpu/implicit/part_start_test.cpp.
const uint kLanes = 256u;
#include "layouts/step_rows.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/part_choices.glsl"
#include "sim/implicit/tries.glsl"
layout(local_size_x = 256) in;

uniform usamplerBuffer chunk_starts;  // of each object, and the end
uniform usamplerBuffer body_rows;     // BodyRows, a texel each
uniform samplerBuffer wave_times;     // of bodies [s]
uniform uint object_count;
uniform uint body_count;
uniform uint row_capacity;
layout(std430) buffer Paces { BodyPace paces[]; };
layout(std430) writeonly buffer Islands { StepIsland islands[]; };
layout(std430) writeonly buffer Pairs { StepPair pairs[]; };
layout(std430) writeonly buffer CouplingStarts { uint coupling_starts[]; };
layout(std430) writeonly buffer Couplings { uint couplings[]; };  // 2 pair + side

uint rows_of(uint body) { return texelFetch(body_rows, int(body)).x; }

// By what all that touches something does.
uint count_parts() {
    float parts = float(kPartsOfStill);
    for (uint o = gl_LocalInvocationID.x; o < body_count; o += kLanes) {
        if (rows_of(o) == 0u) continue;
        parts = max(parts, float(parts_of(paces[o].pace)));
    }
    return uint(max_over_group(parts));
}

float find_deepest() {
    float deepest = 0.0;
    for (uint o = gl_LocalInvocationID.x; o < body_count; o += kLanes)
        deepest = max(deepest, uintBitsToFloat(texelFetch(body_rows, int(o)).w));
    return max_over_group(deepest);
}

// @return whether it is not Euler's
bool choose_scheme(uint o, StepClock now) {
    bool touches = rows_of(o) > 0u, resolves = texelFetch(wave_times, int(o)).x > now.step;
    bool goes_on = has_past_scheme(now, paces[o].pace, paces[o].is_struck != 0u, touches, resolves);
    paces[o].past = goes_on ? 1.0 : 0.0;
    paces[o].damping = least_damping(goes_on, paces[o].pace);
    return goes_on;
}

// Of bodies in their order. @return how many rows there are
uint place_bodies() {
    uint first_row = 0u, first_pair = 0u, first_chunk = 0u;
    for (uint base = 0u; base < body_count; base += kLanes) {
        uint o = base + gl_LocalInvocationID.x, all;
        bool is_body = o < body_count;
        uint count = is_body ? rows_of(o) : 0u;
        uint row = first_row + count_before(count, all);
        first_row += all;
        // There may be no place for the last ones.
        uint row_end = min(row + count, row_capacity);
        row = min(row, row_capacity);
        uint pair_count = row < row_end ? 1u : 0u, pair = first_pair + count_before(pair_count, all);
        first_pair += all;
        uint chunk_count = (row_end - row + kRowsOfChunk - 1u) / kRowsOfChunk;
        uint chunk = first_chunk + count_before(chunk_count, all);
        first_chunk += all;
        if (!is_body) continue;
        paces[o].first_row = row;
        paces[o].row_end = row_end;
        islands[o] = StepIsland(o, o + 1u, texelFetch(chunk_starts, int(o)).x, texelFetch(chunk_starts, int(o) + 1).x, row,
                                row_end, chunk, chunk + chunk_count, pair, pair + pair_count, 0u, 0u);
        coupling_starts[o] = pair;
        if (pair_count == 0u) continue;
        pairs[pair] = StepPair(object_count, o, chunk, chunk + chunk_count);
        couplings[pair] = 2u * pair + 1u;
    }
    for (uint o = body_count + gl_LocalInvocationID.x; o <= object_count; o += kLanes) coupling_starts[o] = first_pair;
    return first_row;
}

void main() {
    StepClock now = with_length(clock[0], count_parts(), find_deepest());
    if (now.goes_on != 0u) {
        bool any_past = false;
        for (uint o = gl_LocalInvocationID.x; o < body_count; o += kLanes) any_past = choose_scheme(o, now) || any_past;
        uint count = place_bodies();
        now.row_count = min(count, row_capacity);
        now.dropped_rows = max(now.dropped_rows, count - now.row_count);
        now.has_past = max_over_group(any_past ? 1.0 : 0.0) > 0.0 ? 1u : 0u;
    }
    barrier();  // all have read the clock
    set_clock(now);
}
