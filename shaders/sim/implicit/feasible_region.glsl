// Which pairs press where surfaces are near each other, so that no place of a surface counts twice. `toward` is the unit vector from
// the first side's nearest point to the second's.
// It explains the method, as does the CPU twin: gelatin::cpu::FeasibleRegion.
#include "layouts/contact_tuning.glsl"

uniform samplerBuffer positions;          // xyz [m]
uniform usamplerBuffer faces;             // Face, a texel each
uniform usamplerBuffer node_face_starts;  // of each node, and the end
uniform usamplerBuffer node_faces;        // ascending
uniform usamplerBuffer across;            // 3 f + k: the face on the other side of an edge, and its corner there; or kNone
uniform usamplerBuffer beside_edges;      // the opposite corners of the faces of each edge, or kNone

vec3 at(uint node) { return texelFetch(positions, int(node)).xyz; }

// A node presses edges and corners of faces where no edge from it leads much towards them: from 0 to 1.
float weight_of_node(uint node, vec3 toward) {
    float weight = 1.0;
    uint end = texelFetch(node_face_starts, int(node) + 1).x;
    for (uint p = texelFetch(node_face_starts, int(node)).x; p < end; ++p) {
        uvec4 face = texelFetch(faces, int(texelFetch(node_faces, int(p)).x));
        for (int k = 0; k < 3; ++k) {
            vec3 edge = at(face[k]) - at(node);
            if (face[k] != node) weight = min(weight, 2.0 - dot(toward, edge) / (kSoftened * length(edge)));
        }
    }
    return max(weight, 0.0);
}

// How nearly the line is along the normal of the pair's face: from 0 to 1.
float weight_along_normal(NearPair near, vec3 toward) {
    vec3 a = at(near.node_1), normal = cross(at(near.node_2) - a, at(near.node_3) - a);
    return clamp(2.0 - length(cross(normal, toward)) / (length(normal) * kSoftened), 0.0, 1.0);
}

// An edge presses away from both its faces.
float weight_of_edge(uint edge_number, vec3 a, vec3 edge, vec3 away) {
    uvec2 beside = texelFetch(beside_edges, int(edge_number)).xy;
    float weight = 1.0;
    for (int k = 0; k < 2; ++k) {
        if (beside[k] == kNone) continue;
        vec3 inwards = at(beside[k]) - a;
        inwards -= dot(inwards, edge) / dot(edge, edge) * edge;
        float size = length(inwards);
        if (!(size > 0.0)) return 0.0;
        weight = min(weight, 0.5 - dot(away, inwards) / (2.0 * kSoftened * size));
    }
    return max(weight, 0.0);
}

float weight_of_edges(NearPair near, vec3 toward) {
    for (int k = 0; k < 4; ++k)
        if (!(near.weights[k] > 0.0)) return 0.0;  // nearest points at ends belong to nodes and faces
    vec3 a = at(near.node_0), b = at(near.node_2);
    return min(weight_of_edge(near.first, a, at(near.node_1) - a, toward),
               weight_of_edge(near.second, b, at(near.node_3) - b, -toward));
}

// Whether what is that way from the nearest point is not nearer.
bool leads_away(vec3 toward, vec3 way) { return dot(toward, way) >= -kHardly * length(way); }

// @param k the edge of the face from corner k to k + 1
bool presses_edge(NearPair near, vec3 toward, uint k) {
    uvec2 other = texelFetch(across, int(3u * near.second + k)).xy;
    if (other.x == kNone) return true;
    return other.x > near.second && leads_away(toward, at(other.y) - at(nodes_of(near)[1u + k]));
}

bool presses_corner(NearPair near, vec3 toward, uint k) {
    uint corner = nodes_of(near)[1u + k], first = texelFetch(node_face_starts, int(corner)).x;
    if (texelFetch(node_faces, int(first)).x != near.second) return false;
    uint end = texelFetch(node_face_starts, int(corner) + 1).x;
    for (uint p = first; p < end; ++p) {
        uvec4 face = texelFetch(faces, int(texelFetch(node_faces, int(p)).x));
        for (int n = 0; n < 3; ++n)
            if (face[n] != corner && !leads_away(toward, at(face[n]) - at(corner))) return false;
    }
    return true;
}

// Within the face, always. At one of its edges or corners, by the lowest of the faces there alone, and only where no face there is
// nearer.
bool presses_face(NearPair near, vec3 toward) {
    vec3 a = at(near.node_1), b = at(near.node_2), c = at(near.node_3), normal = cross(b - a, c - a);
    vec3 edges = vec3(distance(b, c), distance(c, a), distance(a, b));
    bvec3 is_off = lessThanEqual(near.weights.yzw * length(normal), kHardly * near.normal.w * edges);
    uint count = uint(is_off.x) + uint(is_off.y) + uint(is_off.z);
    if (count == 0u) return true;
    if (count == 1u) return presses_edge(near, toward, is_off.z ? 0u : is_off.x ? 1u : 2u);
    return presses_corner(near, toward, is_off.x ? (is_off.y ? 2u : 1u) : 0u);
}

// From 0 to 1: how much of the pair's stiffness it has.
float feasible_weight(NearPair near, vec3 toward) {
    if (near.is_edges != 0u) return weight_of_edges(near, toward);
    if (!presses_face(near, toward)) return 0.0;
    if (all(greaterThan(near.weights.yzw, vec3(0.0)))) return 1.0;
    return max(weight_of_node(near.node_0, toward), weight_along_normal(near, toward));
}
