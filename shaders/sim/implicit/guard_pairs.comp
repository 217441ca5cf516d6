// Whether pairs keep apart on their way: all of them in the first round, then those of nodes that were placed in this round. A pair that
// does not is clipped, and if that was not enough its nodes stay in the frame. After the last round what fails blocks an object, or
// all of its island goes with the frame.
// CPU twin: gelatin::cpu::Guard. Parity: tests/gpu/implicit/pair_guard_test.cpp.
#define WRITES_DISPATCHES
#include "layouts/tries.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/collision/nearest_points.glsl"
#include "sim/implicit/guarded_pairs.glsl"
layout(local_size_x = 64) in;

uniform uint pair_capacity;
uniform samplerBuffer ends;        // where nodes are after this round [m]; w: 0: held
uniform samplerBuffer predicted;   // w: compliances [m/N]
layout(std430) readonly buffer Counts { PairCounts counts[]; };
layout(std430) buffer Clips { NodeClips node_clips[]; };
// Of each pair, for each of its nodes: a half space, and the link to the node's next one, kNone, or kNotClipped.
layout(std430) writeonly buffer HalfSpaces { vec4 half_spaces[]; };
layout(std430) buffer ClipLinks { uint clip_links[]; };
layout(std430) buffer Marks { uint object_marks[]; };
layout(std430) buffer Guard { GuardState guard[]; };

const uint kNotClipped = kNone - 1u;

vec3 end_of(uint n) { return texelFetch(ends, int(n)).xyz; }

mat4x3 starts_of(uvec4 n) { return mat4x3(start_of(n.x), start_of(n.y), start_of(n.z), start_of(n.w)); }
mat4x3 ends_of(uvec4 n) { return mat4x3(end_of(n.x), end_of(n.y), end_of(n.z), end_of(n.w)); }

// How far a direction separates the sides: the least of the second less the most of the first [m].
float separation(bool is_edges, vec3 direction, mat4x3 x) {
    float second = dot(direction, x[1] - x[0]), bottom = min(dot(direction, x[2] - x[0]), dot(direction, x[3] - x[0]));
    return is_edges ? bottom - max(second, 0.0) : min(second, bottom);
}

// @param rounding grows to what it is here @return whether there is a gap
bool measure(bool is_edges, mat4x3 x, inout vec3 normal, inout float rounding) {
    vec3 apart = vec3(0.0), extent = vec3(0.0), reach = abs(x[0]);
    if (is_edges) {
        apart = edge_to_edge(x[0], x[1], x[2], x[3]).apart;
    } else {
        apart = node_to_face(x[0], mat3(x[1], x[2], x[3])).apart;
    }
    float gap = length(apart);
    if (!(gap > 0.0)) return false;
    normal = apart / gap;
    for (int k = 1; k < 4; ++k) {
        extent = max(extent, abs(x[k] - x[0]));
        reach = max(reach, abs(x[k]));
    }
    rounding = max(rounding, kEpsilon * dot(abs(normal), 8.0 * extent + 4.0 * reach));
    return true;
}

// What has to be left of a gap, both less rounding [m].
float least_gap(GuardedPair pair, float gap) {
    return min(kLeastOfReach * pair.reach, max(kLeastOfGap * gap, kLeastOfRounding * pair.rounding));
}

// Piece by piece: from each place on the way goes on as far as the direction there, or that at the end, separates.
bool is_apart(GuardedPair pair, mat4x3 from, mat4x3 to) {
    float gap = pair.gap - pair.rounding;
    if (!(gap > 0.0)) return false;
    float least = least_gap(pair, gap) + pair.rounding;
    if (separation(pair.is_edges, pair.normal, to) >= least) return true;
    float t = 0.0, piece = 1.0, rounding = pair.rounding;
    vec3 normal = pair.normal, ahead = normal;
    mat4x3 here = from;
    while (t < 1.0) {
        float end = t + piece;
        mat4x3 next = end == 1.0 ? to : from + end * (to - from);
        if (!measure(pair.is_edges, next, ahead, rounding)) return false;
        float there = separation(pair.is_edges, ahead, next), enough = least + rounding;
        bool is_separate =
            min(separation(pair.is_edges, normal, here), separation(pair.is_edges, normal, next)) >= enough ||
            min(separation(pair.is_edges, ahead, here), there) >= enough;
        if (is_separate) {
            t = end;
            here = next;
            normal = ahead;
        } else {
            if (end == 1.0 && there < enough) return false;  // too near there
            piece *= 0.5;
            if (piece < kShortestPiece) return false;
        }
    }
    return true;
}

// The rest of this round.
void place_later(uint n) { atomicOr(node_clips[n].rounds, 2u << round_); }
void stay(uint n) {
    if ((atomicOr(node_clips[n].rounds, kStays) & kStays) == 0u) place_later(n);
}
void add(uint n, uint clip, vec4 space) {
    half_spaces[clip] = space;
    clip_links[clip] = atomicExchange(node_clips[n].first, clip);
    place_later(n);
}

// Each side gets a share of the gap.
void clip(uint p, GuardedPair pair, mat4x3 from) {
    float top = 0.0, bottom = kInfinity, first = 0.0, second = 0.0;
    float approach = 0.0;  // of nodes that do not yield
    vec3 frame = frame_of(pair.object);
    vec4 weights = uintBitsToFloat(texelFetch(near_pairs, 5 * int(p) + 1));
    for (uint k = 0u; k < 4u; ++k) {
        uint n = pair.nodes[k];
        float height = dot(pair.normal, from[k] - from[0]);
        float along = is_held(n) ? dot(pair.normal, end_of(n) - from[k] - frame) : 0.0;
        float yields = weights[k] * weights[k] * texelFetch(predicted, int(n)).w;
        if (is_first(pair, k)) {
            top = max(top, height);
            first += yields;
            approach = max(approach, along);
        } else {
            bottom = min(bottom, height);
            second += yields;
            approach = max(approach, -along);
        }
    }
    float gap = bottom - top - pair.rounding, room = gap - least_gap(pair, gap);
    float usable = (room > 0.0 ? (1.0 - kSlightly) : 1.0) * room - approach, share = 0.5;
    if (first + second > 0.0) {
        share = first / (first + second);
        if (first > 0.0 && second > 0.0) share = clamp(share, kSlightly, 1.0 - kSlightly);
    }
    for (uint k = 0u; k < 4u; ++k) {
        uint n = pair.nodes[k];
        clip_links[4u * p + k] = kNone;
        if (is_held(n)) continue;
        float height = dot(pair.normal, from[k] - from[0]);
        if (!(gap > 0.0)) {
            stay(n);
        } else if (is_first(pair, k)) {
            add(n, 4u * p + k, vec4(pair.normal, top - height + share * usable));
        } else {
            add(n, 4u * p + k, vec4(-pair.normal, height - bottom + (1.0 - share) * usable));
        }
    }
    atomicAdd(guard[0].clipped, 1u);
}

// What moves nodes: then they are placed, and pairs of theirs checked again.
void do_again() {
    uint next = kGuardRound + 2u * round_, last = kGuardRound + 2u * kGuardRounds;
    atomicMax(dispatches[next + 1u].groups_x, dispatches[next + 1u].count);
    atomicMax(dispatches[next + 2u].groups_x, dispatches[next + 2u].count);
    atomicMax(dispatches[last].groups_x, dispatches[last].count);
}

// A pair that still fails. What is held and goes on, though free nodes have given way as far as they can, is blocked.
void give_up(GuardedPair pair, bool is_clipped) {
    bool moves = false, is_blocked = false;
    for (uint k = 0u; k < 4u; ++k) {
        uint n = pair.nodes[k], object = is_first(pair, k) ? pair.object : pair.other;
        bool is_moving = is_held(n) ? end_of(n) != start_of(n) : (node_clips[n].rounds & kStays) == 0u;
        moves = moves || is_moving;
        if (!is_clipped || !is_moving || !is_held(n)) continue;
        atomicOr(object_marks[object], kIsBlocked);
        is_blocked = true;
    }
    if (moves) atomicOr(object_marks[island_of(pair.object)], is_blocked ? kHasBlocked : kHasFailed);
}

void main() {
    uint p = global_index();
    if (p >= min(counts[0].pairs, pair_capacity)) return;
    GuardedPair pair = fetch_pair(p);
    bool is_last = round_ == kGuardRounds, is_clipped = round_ > 0u && clip_links[4u * p] != kNotClipped;
    if (round_ == 0u) clip_links[4u * p] = kNotClipped;
    uint placed = 0u;
    for (uint k = 0u; k < 4u; ++k) placed |= node_clips[pair.nodes[k]].rounds;
    bool is_due = round_ == 0u || (placed >> round_ & 1u) != 0u || (is_last && is_clipped);
    if (!is_due) return;
    mat4x3 from = starts_of(pair.nodes), to = ends_of(pair.nodes);
    if (is_apart(pair, from, to)) return;
    if (is_clipped && separation(pair.is_edges, pair.normal, to) >= pair.rounding) return;
    if (is_last) {
        give_up(pair, is_clipped);
        return;
    }
    if (is_clipped) {
        for (uint k = 0u; k < 4u; ++k)
            if (!is_held(pair.nodes[k])) stay(pair.nodes[k]);
    } else {
        clip(p, pair, from);
    }
    do_again();
}
