// Whether the part is short enough for what its bodies touch, and all has a place; if so, where the rows of islands and bodies go in
// the tables. One work group.
// CPU twin: gelatin::cpu::ImplicitStep::run. Parity: tests/gpu/implicit/pair_rows_test.cpp.
const uint kLanes = 256u;
#include "layouts/step_rows.glsl"
#include "sim/implicit/group_counts.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/near_pairs.glsl"
#include "sim/collision/make_dispatch.glsl"
#include "sim/implicit/part_choices.glsl"
#include "sim/implicit/tries.glsl"
layout(local_size_x = 256) in;

uniform usamplerBuffer chunk_starts;   // of each object, and the end
uniform usamplerBuffer labels;         // the least body of each one's island
uniform usamplerBuffer island_bodies;  // in the order of islands
uniform usamplerBuffer body_touches;   // BodyTouch, two texels each
uniform usamplerBuffer paces;          // BodyPace, five texels each
uniform uint object_count;
uniform uint row_capacity;
layout(std430) buffer Islands { StepIsland islands[]; };
layout(std430) writeonly buffer IslandOfObject { uint island_of_object[]; };
layout(std430) writeonly buffer BodyPlaces { BodyPlace body_places[]; };
layout(std430) writeonly buffer CouplingStarts { uint coupling_starts[]; };

uint label_of(uint o) { return texelFetch(labels, int(o)).x; }
uvec4 touch_of(uint o) { return texelFetch(body_touches, 2 * int(o)); }  // rows, pairs, chunks of rows, couplings

// By what all that touches something does.
uint count_parts() {
    float parts = float(kPartsOfStill);
    for (uint o = gl_LocalInvocationID.x; o < body_count; o += kLanes)
        if (touch_of(o).x + touch_of(o).w > 0u) parts = max(parts, float(parts_of(texelFetch(paces, 5 * int(o)).x)));
    return uint(max_over_group(parts));
}

float find_deepest() {
    float deepest = 0.0;
    for (uint o = gl_LocalInvocationID.x; o < body_count; o += kLanes)
        deepest = max(deepest, uintBitsToFloat(texelFetch(body_touches, 2 * int(o) + 1).z));
    return max_over_group(deepest);
}

// Of a body, the r-th in the order of islands.
void place(uint r, uvec4 at, uvec4 end) {
    uint o = texelFetch(island_bodies, int(r)).x, island = label_of(o);
    body_places[o] = BodyPlace(at.x, at.y, at.z, at.w);
    if (island == o) {
        islands[o].first_body = r;
        islands[o].first_row = at.x;
        islands[o].first_pair = at.y;
        islands[o].first_row_chunk = at.z;
        islands[o].first_chunk = at.w;
    }
    if (r + 1u < body_count && label_of(texelFetch(island_bodies, int(r) + 1).x) == island) return;
    islands[island].body_end = r + 1u;
    islands[island].row_end = end.x;
    islands[island].pair_end = end.y;
    islands[island].row_chunk_end = end.z;
    islands[island].chunk_end = end.w;
}

// @return how many rows there are
uint place_bodies() {
    uvec4 first = uvec4(0u), all;
    for (uint base = 0u; base < body_count; base += kLanes) {
        uint r = base + gl_LocalInvocationID.x;
        uvec4 own = uvec4(0u), at;
        if (r < body_count) {
            int o = int(texelFetch(island_bodies, int(r)).x);
            own = uvec4(touch_of(uint(o)).xyz, texelFetch(chunk_starts, o + 1).x - texelFetch(chunk_starts, o).x);
        }
        at.x = count_before(own.x, all.x);
        at.y = count_before(own.y, all.y);
        at.z = count_before(own.z, all.z);
        at.w = count_before(own.w, all.w);
        if (r < body_count) place(r, first + at, first + at + own);
        first += all;
    }
    return first.x;
}

void place_couplings() {
    uint first = 0u, all;
    for (uint base = 0u; base <= object_count; base += kLanes) {
        uint o = base + gl_LocalInvocationID.x;
        uint before = count_before(o < body_count ? touch_of(o).w : 0u, all);
        if (o <= object_count) coupling_starts[o] = first + before;
        first += all;
    }
}

// Also of objects that have no islands.
void number_islands() {
    for (uint o = gl_LocalInvocationID.x; o < object_count; o += kLanes) {
        uint island = o < body_count ? label_of(o) : kNone;
        island_of_object[o] = island;
        if (island != o) islands[o] = StepIsland(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    }
}

// What has no place the host makes a place for.
StepClock given_up(StepClock now, uint missing) {
    now.is_full = 1u;
    now.goes_on = 0u;
    now.dropped_rows = max(now.dropped_rows, missing);
    return now;
}

void main() {
    StepClock now = clock[0];
    if (counts[0].is_full != 0u) now = given_up(now, 0u);
    else if (counts[0].fastest > kFastest && !is_shortest(now)) now = halved(now);
    else now = with_length(now, count_parts(), find_deepest());
    if (now.goes_on != 0u) {
        uint count = place_bodies();
        place_couplings();
        now.has_past = 0u;  // until an island has
        now.row_count = min(count, row_capacity);
        if (count > row_capacity) now = given_up(now, count - row_capacity);
    }
    memoryBarrierBuffer();
    barrier();  // all have read the clock, and islands are written
    number_islands();
    set_clock(now);
    if (now.goes_on != 0u && gl_LocalInvocationID.x == 0u) dispatches[kRows] = dispatch_invocations(now.row_count);
}
