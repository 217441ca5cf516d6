// Small depth maps of a surface, each seen from a light of its own: one invocation fills one face into all of them.
// Faces are hardly larger than the maps' texels, where a rasteriser spends all its time on setting triangles up, on one
// thread in software drivers. Minima do not depend on the order, so the maps have the same bits each time. CUT: surfaces
// are cut open by the plane of an overlay, and faces seen from within count too.
#include "include/global_index.glsl"
#include "render/include/surface_fetch.glsl"
#ifdef CUT
#include "render/include/cut.glsl"
#endif
layout(local_size_x = 64) in;

const int kMostMaps = 2;

uniform usamplerBuffer triangles;  // surface vertices of each face
layout(std430) buffer DepthMaps { uint depths[]; };  // 2^32 - 1 is the far plane, [map][row][column]
uniform mat4 world_to_map[kMostMaps];  // texels, and depth in [0, 1]; no perspective
uniform ivec2 map_size[kMostMaps];     // [texels]
uniform int map_start[kMostMaps];      // of each map in depths
uniform int map_count;
uniform uint face_count;

const float kFarthest = 4294967040.0;  // the largest float that is a uint

vec3 corner(uint vertex) { return fetch_point(int(vertex)).position; }

float cross_2d(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// The texels whose centres lie in the face; corners in texels. @param kept how deep each corner is below the cut [m]
void fill_face(vec3 a, vec3 b, vec3 c, vec3 kept, ivec2 size, int start) {
    float area = cross_2d(b.xy - a.xy, c.xy - a.xy);  // twice; > 0 for faces that look at the light
    // Those in the face's bounding rectangle; a loop of no turns is left sooner than a branch.
    ivec2 first = ivec2(clamp(ceil(min(a.xy, min(b.xy, c.xy)) - 0.5), vec2(0.0), vec2(size)));
    ivec2 end = ivec2(clamp(ceil(max(a.xy, max(b.xy, c.xy)) - 0.5), vec2(0.0), vec2(size)));
#ifdef CUT
    end.y = area != 0.0 ? end.y : first.y;
#else
    end.y = area > 0.0 ? end.y : first.y;
#endif
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            vec2 at = vec2(x, y) + 0.5;
            // Barycentric coordinates.
            vec3 weight = vec3(cross_2d(c.xy - b.xy, at - b.xy), cross_2d(a.xy - c.xy, at - c.xy),
                               cross_2d(b.xy - a.xy, at - a.xy)) / area;
            if (min(weight.x, min(weight.y, weight.z)) < 0.0) continue;
#ifdef CUT
            if (dot(weight, kept) < 0.0) continue;
#endif
            float depth = clamp(dot(weight, vec3(a.z, b.z, c.z)), 0.0, 1.0);
            atomicMin(depths[start + y * size.x + x], uint(depth * kFarthest));
        }
    }
}

void main() {
    uint f = global_index();
    if (f >= face_count) return;
    uvec3 face = texelFetch(triangles, int(f)).xyz;
    vec4 a = vec4(corner(face.x), 1.0), b = vec4(corner(face.y), 1.0), c = vec4(corner(face.z), 1.0);
#ifdef CUT
    vec3 kept = vec3(depth_below_cut(a.xyz), depth_below_cut(b.xyz), depth_below_cut(c.xyz));
#else
    vec3 kept = vec3(0.0);
#endif
    for (int m = 0; m < map_count; ++m) {
        mat4 to_map = world_to_map[m];
        fill_face((to_map * a).xyz, (to_map * b).xyz, (to_map * c).xyz, kept, map_size[m], map_start[m]);
    }
}
