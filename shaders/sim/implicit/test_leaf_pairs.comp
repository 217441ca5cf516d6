// Which elements of two leaves, nodes of the first and faces of the second, and edges, may come nearer than their reach: a bit each, and
// how many; with LIST the near pairs. Eight invocations two leaves, each with up to three of the first one's elements: bits of 12.
// CPU twin: gelatin::cpu::FindPairs. Parity: tests/gpu/implicit/find_pairs_test.cpp.
#include "include/global_index.glsl"
#include "layouts/near_pair.glsl"
#include "sim/collision/dispatches.glsl"
#include "sim/collision/nearest_points.glsl"
#include "sim/implicit/list_starts.glsl"
#include "sim/implicit/path_boxes.glsl"
#ifdef LIST
#include "sim/implicit/clock.glsl"
#endif
layout(local_size_x = 64) in;

uniform usamplerBuffer pair_slots;   // PairSlot
uniform usamplerBuffer searches;     // leaf, slot
uniform usamplerBuffer leaf_pairs;   // search, leaf
uniform usamplerBuffer tree_nodes;   // TreeNode
uniform usamplerBuffer face_starts;  // of each face in surface_nodes and face_edges
uniform usamplerBuffer surface_nodes;
uniform usamplerBuffer face_edges;   // FaceEdge
uniform usamplerBuffer faces;        // Face

#ifdef LIST
uniform usamplerBuffer hit_starts;  // by leaf pair
uniform usamplerBuffer hit_sums;
uniform usamplerBuffer hits;        // by invocation
uniform samplerBuffer velocities;   // when the part begins [m/s]
uniform uint body_count;
uniform uint pair_capacity;
layout(std430) writeonly buffer NearPairs { NearPair near_pairs[]; };
#else
layout(std430) writeonly buffer Hits { uvec2 hits[]; };
layout(std430) writeonly buffer Starts { uint starts[]; };  // counts
#endif

struct LeafPair {
    uint slot, object, other;
    uvec4 of;  // the first leaf: its first node, edge, the ends of both
    uvec4 to;  // the second leaf: its first face, edge, the ends of both
    bool has_edges;
};

LeafPair fetch_leaf_pair(uint p) {
    uvec2 pair = texelFetch(leaf_pairs, int(p)).xy, search = texelFetch(searches, int(pair.x)).xy;
    uvec2 slot = texelFetch(pair_slots, int(search.y)).xy;
    uvec2 one = texelFetch(tree_nodes, int(search.x)).yz, two = texelFetch(tree_nodes, int(pair.y)).yz;
    uvec4 of = uvec4(texelFetch(face_starts, int(one.x)).xy, texelFetch(face_starts, int(one.x + one.y)).xy);
    uvec4 to = uvec4(two.x, texelFetch(face_starts, int(two.x)).y, two.x + two.y,
                     texelFetch(face_starts, int(two.x + two.y)).y);
    return LeafPair(search.y, slot.x, slot.y, of, to, slot.x == slot.y ? two.x >= one.x : slot.y > slot.x);
}

// A node or an edge, and what is tested against it.
struct Element {
    bool is_edge;
    uint number;        // of the node, or of the edge
    uvec2 nodes;
    uint first, count;  // faces, or edges
};

Element fetch_element(LeafPair pair, uint e) {
    uint nodes = pair.of.z - pair.of.x, edges = pair.of.w - pair.of.y;
    if (e < nodes) {
        uint n = texelFetch(surface_nodes, int(pair.of.x + e)).x;
        return Element(false, n, uvec2(n), pair.to.x, pair.to.z - pair.to.x);
    }
    if (e - nodes >= edges || !pair.has_edges) return Element(false, 0u, uvec2(0u), 0u, 0u);
    uint edge = pair.of.y + e - nodes;
    return Element(true, edge, texelFetch(face_edges, int(edge)).xy, pair.to.y, pair.to.w - pair.to.y);
}

// The nodes of a face or edge that is tested; z of an edge is its second end again.
uvec3 nodes_of(Element element, uint second) {
    if (element.is_edge) return texelFetch(face_edges, int(second)).xyy;
    return texelFetch(faces, int(second)).xyz;
}

// Of one body, sides have no node in common, and of two edges the first one has the pair.
bool may_meet(LeafPair pair, Element element, uint second, uvec3 nodes) {
    if (pair.object != pair.other) return true;
    return !(element.is_edge && second <= element.number) && !any(equal(nodes, uvec3(element.nodes.x))) &&
           !any(equal(nodes, uvec3(element.nodes.y)));
}

struct Measured {
    vec4 weights;
    vec3 normal;
    float gap;
};

// The nodes of an element, of an edge or of a node twice, and of what is tested, of an edge an end twice.
mat2x3 starts_of(Element element) { return mat2x3(position(element.nodes.x), position(element.nodes.y)); }
mat3 starts_of(uvec3 nodes) { return mat3(position(nodes.x), position(nodes.y), position(nodes.z)); }

Measured measure(bool is_edge, mat2x3 of, mat3 to) {
    vec3 apart;
    vec4 weights;
    if (is_edge) {
        EdgeToEdge at = edge_to_edge(of[0], of[1], to[0], to[1]);
        apart = at.apart;
        weights = vec4(1.0 - at.fraction, at.fraction, 1.0 - at.other_fraction, at.other_fraction);
    } else {
        NodeToFace at = node_to_face(of[0], to);
        apart = at.apart;
        weights = vec4(1.0, at.weights);
    }
    float gap = length(apart);
    return Measured(weights, gap > 0.0 ? apart / gap : vec3(0.0), gap);
}

// How far a direction separates both sides.
float separation(mat2x3 of, mat3 to, vec3 direction) {
    float top = max(dot(direction, of[1] - of[0]), 0.0);
    vec3 heights = vec3(dot(direction, to[0] - of[0]), dot(direction, to[1] - of[0]), dot(direction, to[2] - of[0]));
    return min(heights.x, min(heights.y, heights.z)) - top;
}

float reach_of(LeafPair pair) { return thickness_of(pair.object) + thickness_of(pair.other); }

#ifdef LIST
// Of a difference of heights along the normal.
float rounding_of(Element element, uvec3 nodes, vec3 normal) {
    vec3 origin = position(element.nodes.x), extent = vec3(0.0), reach = abs(origin);
    uvec4 others = uvec4(element.nodes.y, nodes);
    for (int k = 0; k < 4; ++k) {
        vec3 x = position(others[k]);
        extent = max(extent, abs(x - origin));
        reach = max(reach, abs(x));
    }
    return kEpsilon * dot(abs(normal), 8.0 * extent + 4.0 * reach);
}

// Of what goes on by more than half of its gap: the direction where it is nearest on this way. What passes an edge or a corner meets
// it beside, and not ahead. The second side goes beside the first as its nearest point does.
Measured look_beside_way(Measured at, Element element, uvec3 nodes, uvec4 both, float reach) {
    vec3 way = vec3(0.0);
    for (int k = 0; k < 4; ++k) {
        bool is_first = k < (element.is_edge ? 2 : 1);
        way += (is_first ? -at.weights[k] : at.weights[k]) * clock[0].step * texelFetch(velocities, int(both[k])).xyz;
    }
    if (!element.is_edge && all(greaterThan(at.weights.yzw, vec3(kHardly)))) return at;
    float square = dot(way, way);
    if (!(4.0 * square > at.gap * at.gap) || !(dot(way, at.normal) < 0.0)) return at;
    mat2x3 of = starts_of(element);
    mat3 to = starts_of(nodes), ways = mat3(way, way, way);
    Measured there = measure(element.is_edge, of, to + ways);
    float time = 1.0, halved = 1.0;  // the distance of convex sides is convex in time
    for (int k = 0; k < 5 && (k > 0 || dot(there.normal, way) > 0.0); ++k) {
        halved *= 0.5;
        time += dot(there.normal, way) > 0.0 ? -halved : halved;
        there = measure(element.is_edge, of, to + time * ways);
    }
    vec3 apart = there.gap * there.normal;
    if (time < 1.0) apart -= dot(apart, way) / square * way;
    float size = length(apart), least = kLeastOfReach * reach;
    if (!(size > least)) return at;
    float gap = separation(of, to, apart / size);
    return gap > least ? Measured(at.weights, apart / size, gap) : at;
}

NearPair make_pair(LeafPair pair, Element element, uint second) {
    uvec3 nodes = nodes_of(element, second);
    uvec4 all = element.is_edge ? uvec4(element.nodes, nodes.xy) : uvec4(element.nodes.x, nodes);
    Measured at = measure(element.is_edge, starts_of(element), starts_of(nodes));
    // Not between bodies: what these exert on each other along another line would have a moment.
    if (max(pair.object, pair.other) >= body_count) at = look_beside_way(at, element, nodes, all, reach_of(pair));
    return NearPair(all.x, all.y, all.z, all.w, at.weights, vec4(at.normal, at.gap), element.number, second,
                    element.is_edge ? 1u : 0u, pair.slot, pair.object, pair.other, reach_of(pair),
                    rounding_of(element, nodes, at.normal));
}

void main() {
    uint index = global_index(), p = index / kLanesALeafPair, lane = index % kLanesALeafPair;
    if (p >= dispatches[kWrites].count) return;
    LeafPair pair = fetch_leaf_pair(p);
    uint place = list_start(hit_starts, hit_sums, p);
    for (uint k = index - lane; k < index; ++k) {
        uvec2 before = texelFetch(hits, int(k)).xy;
        place += uint(bitCount(before.x) + bitCount(before.y));
    }
    uvec2 own = texelFetch(hits, int(index)).xy;
    for (uint k = 0u; k < 3u; ++k) {
        uint bits = k < 2u ? own.x >> (16u * k) & 0xFFFFu : own.y;
        if (bits == 0u) continue;
        Element element = fetch_element(pair, lane + kLanesALeafPair * k);
        for (; bits != 0u && place < pair_capacity; bits &= bits - 1u)
            near_pairs[place++] = make_pair(pair, element, element.first + uint(findLSB(bits)));
    }
}
#else
const uint kFeatures = 16u, kFaces = 4u;  // of the second leaf: faces, then edges
shared uvec3 feature_nodes[64u / kLanesALeafPair * kFeatures];
shared vec3 lows[64u / kLanesALeafPair * kFeatures], highs[64u / kLanesALeafPair * kFeatures];

// The nodes and boxes of the second leaf's. @param first of the pair of leaves
void find_features(LeafPair pair, uint first, uint lane) {
    Frame frame = frame_of(pair.other);
    for (uint k = lane; k < kFeatures; k += kLanesALeafPair) {
        bool is_edge = k >= kFaces;
        uint number = is_edge ? pair.to.y + k - kFaces : pair.to.x + k;
        if (number >= (is_edge ? pair.to.w : pair.to.z) || (is_edge && !pair.has_edges)) continue;
        uvec3 nodes = is_edge ? texelFetch(face_edges, int(number)).xyy : texelFetch(faces, int(number)).xyz;
        Bounds box = path_bounds(nodes, frame);
        feature_nodes[first + k] = nodes;
        lows[first + k] = box.min;
        highs[first + k] = box.max;
    }
}

// The bits of what is near an element.
uint test_element(LeafPair pair, Element element, uint first) {
    uint candidates = 0u, near = 0u;
    if (element.count == 0u) return 0u;
    if (element.is_edge) first += kFaces;
    Bounds box = swept(path_bounds(element.nodes.xyy, frame_of(pair.object)), motion_of(pair.object) - motion_of(pair.other));
    for (uint k = 0u; k < element.count; ++k) {
        bool is_candidate = meet(box.min, box.max, lows[first + k], highs[first + k]) &&
                            may_meet(pair, element, element.first + k, feature_nodes[first + k]);
        candidates |= uint(is_candidate) << k;
    }
    float wanted = (1.0 + kPathSlack) * reach_of(pair);
    for (; candidates != 0u; candidates &= candidates - 1u) {
        uint k = uint(findLSB(candidates));
        uvec3 nodes = feature_nodes[first + k];
        Measured at = measure(element.is_edge, starts_of(element), starts_of(nodes));
        bool is_far = at.gap > wanted && separation(mat2x3(path_end(element.nodes.x), path_end(element.nodes.y)),
                                                       mat3(path_end(nodes.x), path_end(nodes.y), path_end(nodes.z)), at.normal) > wanted;
        near |= uint(!is_far) << k;
    }
    return near;
}

shared uint lane_hits[64];

void main() {
    uint index = global_index(), p = index / kLanesALeafPair, lane = index % kLanesALeafPair;
    uint here = gl_LocalInvocationID.x, first = here / kLanesALeafPair * kFeatures, count = 0u;
    uvec2 own = uvec2(0u);
    bool is_pair = p < dispatches[2u * kOfLeafPairs].count;
    LeafPair pair;
    if (is_pair) {
        pair = fetch_leaf_pair(p);
        find_features(pair, first, lane);
    }
    barrier();
    if (is_pair) {
        for (uint k = 0u; k < 3u; ++k) {
            uint bits = test_element(pair, fetch_element(pair, lane + kLanesALeafPair * k), first);
            if (k < 2u) {
                own.x |= bits << (16u * k);
            } else {
                own.y = bits;
            }
        }
        hits[index] = own;
    }
    lane_hits[here] = uint(bitCount(own.x) + bitCount(own.y));
    barrier();
    if (!is_pair || lane != 0u) return;
    for (uint k = 0u; k < kLanesALeafPair; ++k) count += lane_hits[here + k];
    starts[p] = count;
}
#endif
