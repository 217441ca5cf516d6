// The nearest points of two faces, edges or nodes. CPU twin, which explains the method: src/cpu/collision/nearest_points.h.
// `apart` points from the first one to the second. Parity: tests/gpu/collision/time_of_impact_test.cpp. The columns of a face are its corners.

#include "sim/collision/rounding.glsl"

const float kParallel = float(kParallelRounding) * kEpsilon;
const float kInfinity = 3.4e38;

struct NodeToEdge {
    float fraction;
    vec3 apart;
    float squared_distance;
};
struct NodeToFace {
    vec3 weights;
    vec3 apart;
    float squared_distance;
};
struct EdgeToEdge {
    float fraction;
    float other_fraction;
    vec3 apart;
    float squared_distance;
};

NodeToEdge node_to_edge(vec3 p, vec3 a, vec3 b) {
    vec3 edge = b - a, to_edge = a - p;
    float squared_length = dot(edge, edge);
    float along = squared_length > 0.0 ? -dot(to_edge, edge) / squared_length : 0.0;
    float fraction = clamp(along, 0.0, 1.0);
    vec3 apart = to_edge + fraction * edge;
    if (along > 0.0 && along < 1.0) apart -= dot(apart, edge) / squared_length * edge;
    return NodeToEdge(fraction, apart, dot(apart, apart));
}

NodeToFace node_to_face(vec3 p, mat3 face) {
    vec3 u = face[1] - face[0], v = face[2] - face[0], w = p - face[0];
    vec3 normal = cross(u, v);
    float size = dot(normal, normal);
    float second = dot(cross(w, v), normal), third = dot(cross(u, w), normal);
    bool inner = size > kParallel * dot(u, u) * dot(v, v) && second >= 0.0 && third >= 0.0 && second + third <= size;

    NodeToFace nearest = NodeToFace(vec3(0.0), vec3(0.0), kInfinity);
    vec3 corner = vec3(1.0, 0.0, 0.0);
    for (int k = 0; k < 3; ++k) {
        NodeToEdge edge = node_to_edge(p, face[0], face[1]);
        vec3 weights = corner + edge.fraction * (corner.zxy - corner);
        if (edge.squared_distance < nearest.squared_distance) {
            nearest = NodeToFace(weights, edge.apart, edge.squared_distance);
        }
        face = mat3(face[1], face[2], face[0]);
        corner = corner.zxy;
    }
    vec3 apart = -(dot(w, normal) / size) * normal;
    if (inner) nearest = NodeToFace(vec3(size - second - third, second, third) / size, apart, dot(apart, apart));
    return nearest;
}

// Infinite if the nearest points of the edges' lines are not within them.
EdgeToEdge inner_edge_to_edge(vec3 a, vec3 b, vec3 c, vec3 d) {
    vec3 u = b - a, v = d - c, w = c - a;
    vec3 normal = cross(u, v);
    float size = dot(normal, normal);
    float first = dot(cross(w, v), normal), second = dot(cross(w, u), normal);
    bool inner = size > kParallel * dot(u, u) * dot(v, v) && first >= 0.0 && first <= size && second >= 0.0 &&
                 second <= size;
    vec3 apart = dot(w, normal) / size * normal;
    if (!inner) return EdgeToEdge(0.0, 0.0, vec3(0.0), kInfinity);
    return EdgeToEdge(first / size, second / size, apart, dot(apart, apart));
}

EdgeToEdge edge_to_edge(vec3 a, vec3 b, vec3 c, vec3 d) {
    EdgeToEdge nearest = inner_edge_to_edge(a, b, c, d);
    for (int k = 0; k < 2; ++k) {
        NodeToEdge from = node_to_edge(k == 0 ? a : b, c, d), to = node_to_edge(k == 0 ? c : d, a, b);
        if (from.squared_distance < nearest.squared_distance) {
            nearest = EdgeToEdge(float(k), from.fraction, from.apart, from.squared_distance);
        }
        if (to.squared_distance < nearest.squared_distance) {
            nearest = EdgeToEdge(to.fraction, float(k), -to.apart, to.squared_distance);
        }
    }
    return nearest;
}

// The vector between the nearest points of two faces. Loops rotate the corners, because a variable index would move them to
// memory.
vec3 shortest_between(mat3 s, mat3 t) {
    vec4 shortest = vec4(0.0, 0.0, 0.0, kInfinity);
    for (int k = 0; k < 3; ++k) {
        NodeToFace from = node_to_face(s[0], t), to = node_to_face(t[0], s);
        if (from.squared_distance < shortest.w) shortest = vec4(from.apart, from.squared_distance);
        if (to.squared_distance < shortest.w) shortest = vec4(-to.apart, to.squared_distance);
        s = mat3(s[1], s[2], s[0]);
        t = mat3(t[1], t[2], t[0]);
    }
    for (int k = 0; k < 9; ++k) {  // ends have been compared above
        EdgeToEdge edges = inner_edge_to_edge(s[0], s[1], t[0], t[1]);
        if (edges.squared_distance < shortest.w) shortest = vec4(edges.apart, edges.squared_distance);
        t = mat3(t[1], t[2], t[0]);
        if (k % 3 == 2) s = mat3(s[1], s[2], s[0]);
    }
    return shortest.xyz;
}
