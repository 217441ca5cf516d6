// The polygon in which a plane cuts a tet, three or four corners, as two triangles of the corners 0 1 2 and 0 2 3; of
// three corners the last is the first once more. Needs find_cut_tets.comp.
#include "render/include/cut.glsl"

uniform samplerBuffer node_positions;  // xyz [m]
uniform usamplerBuffer tets;           // nodes
uniform usamplerBuffer met_tets;
uniform samplerBuffer object_colors;  // linear RGB
uniform usamplerBuffer tet_objects;
#ifdef COLOR_MAP
uniform samplerBuffer tet_values;
flat out float value;
#else
flat out vec3 albedo;
#endif
uniform mat4 world_to_clip;
uniform vec2 picture_size;  // [pixels]

out vec4 side_distances;       // from the polygon's sides [m]
flat out float polygon_size;  // [pixels], about

const float kNoSide = 1e30;
// Bodies that are in one another are cut at the same depth: one of them comes before the other by what rounding of
// depths does not reach.
const uint kRanks = 16u;
const float kRankDepth = 2e-6;
// By which of the tet's corners are cut away, a bit each: the edges that the polygon's corners lie on, in order, four
// bits each, which are two corners of the tet. Only the first eight: the others are the first ones turned round.
const uint kEdges[8] = uint[8](0x0000u, 0x1321u, 0x1761u, 0x6732u, 0x2b62u, 0x6b31u, 0x2b71u, 0x3b73u);

vec3 corner_on(uint edge, vec3 positions[4], float depths[4]) {
    uint i = edge >> 2u, j = edge & 3u;
    return mix(positions[i], positions[j], depths[i] / (depths[i] - depths[j]));
}

float distance_from_side(vec3 point, vec3 a, vec3 b) {
    float length_ = distance(a, b);
    return length_ > 0.0 ? length(cross(b - a, point - a)) / length_ : kNoSide;
}

void main() {
    uint t = texelFetch(met_tets, gl_VertexID / 6).x;
    uvec4 tet = texelFetch(tets, int(t));
    vec3 positions[4];
    float depths[4];
    uint away = 0u;
    for (int k = 0; k < 4; ++k) {
        positions[k] = texelFetch(node_positions, int(tet[k])).xyz;
        depths[k] = depth_below_cut(positions[k]);
        away |= uint(depths[k] < 0.0) << k;
    }
    uint edges = kEdges[away < 8u ? away : 15u - away];
    vec3 corners[4];
    for (int c = 0; c < 4; ++c) corners[c] = corner_on(edges >> 4 * c & 15u, positions, depths);
    int own = int[6](0, 1, 2, 0, 2, 3)[gl_VertexID % 6];
    for (int c = 0; c < 4; ++c)
        side_distances[c] = distance_from_side(corners[own], corners[c], corners[(c + 1) % 4]);
    uint object = texelFetch(tet_objects, int(t)).x;
    gl_Position = world_to_clip * vec4(corners[own], 1.0);
    gl_Position.z -= float(object % kRanks) * kRankDepth * gl_Position.w;
    float across = max(distance(corners[0], corners[2]), distance(corners[1], corners[3]));
    vec3 upwards = vec3(world_to_clip[0].y, world_to_clip[1].y, world_to_clip[2].y);
    polygon_size = 0.5 * picture_size.y * length(upwards) * across / gl_Position.w;
#ifdef COLOR_MAP
    value = texelFetch(tet_values, int(t)).x;
#else
    albedo = texelFetch(object_colors, int(object)).rgb;
#endif
}
