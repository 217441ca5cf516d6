// The fraction of the ambient light that reaches the surface in a pixel: the cosine-weighted part of the hemisphere above the
// horizons in the depth map around it (Jimenez, Wu, Pesce and Jarabo 2016, ground-truth ambient occlusion). Each pixel of a
// tile of 4 x 4 uses different directions; blur_occlusion.frag averages over such a tile. The tiles stay fixed from frame to
// frame. Bodies occlude; the floor does not, because it reflects light.
#include "render/include/seen_points.glsl"

uniform float reach;  // how far away something is still felt [m]

layout(location = 0) out vec2 occlusion;  // openness in [0, 1], distance [m], < 0 on the floor

const int kSlices = 2;  // planes that hold the direction to the eye
const mat2 kNextSlice = mat2(0.0, 1.0, -1.0, 0.0);
const int kSteps = 6;             // along each half of a slice
const float kMostPixels = 120.0;  // that the reach may cover
const float kFlat = 0.1;          // slope of what is taken for the rounding of a flat surface
const float kFarthest = 6e4;      // [m]; half floats end at 65,504
const float kPi = 3.14159265;

// A number in [0, 16) for each pixel of a tile, such that neighbours differ most (Bayer 1973).
int tile_index(ivec2 pixel) {
    const int kOrder[16] = int[](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);
    return kOrder[4 * (pixel.y & 3) + (pixel.x & 3)];
}

// From the point to the next one on the same surface: of both neighbours the one whose depth differs less.
vec3 along_surface(vec3 point, ivec2 pixel, ivec2 side) {
    ivec2 last = textureSize(body_depths, 0) - 1, next = pixel + side, previous = pixel - side;
    if (any(greaterThan(next, last))) return point - body_point(previous);
    vec3 after = body_point(next) - point;
    if (any(lessThan(previous, ivec2(0)))) return after;
    vec3 before = point - body_point(previous);
    return abs(before.z) < abs(after.z) ? before : after;
}

vec3 body_normal(vec3 point, ivec2 pixel) {
    vec3 normal = cross(along_surface(point, pixel, ivec2(1, 0)), along_surface(point, pixel, ivec2(0, 1)));
    float square = dot(normal, normal);
    return square > 0.0 ? normal * inversesqrt(square) : vec3(0.0, 0.0, 1.0);
}

// The cosine of the horizon's angle from the direction to the eye, at least `lowest`.
float find_horizon(vec3 point, vec3 normal, vec3 to_eye, ivec2 pixel, vec2 direction, float pixels, float shift,
                   float lowest, int steps) {
    float horizon = lowest;
    ivec2 last = textureSize(body_depths, 0) - 1;
    vec2 middle = vec2(pixel) + 0.5;
    for (int i = 0; i < steps; ++i) {
        float along = (float(i) + shift) / float(kSteps);
        ivec2 at = ivec2(floor(middle + direction * (1.0 + along * along * pixels)));
        ivec2 inside = clamp(at, ivec2(0), last);
        vec3 offset = body_point(inside) - point;
        float distance = max(length(offset), 1e-15);
        // Everything that rises above the tangent has full effect up to half the radius.
        float nearness = at == inside ? clamp(2.0 - 2.0 * distance / reach, 0.0, 1.0) : 0.0;
        nearness *= smoothstep(0.0, kFlat, dot(offset, normal) / distance);
        horizon = max(horizon, mix(lowest, dot(offset, to_eye) / distance, nearness));
    }
    return min(horizon, 1.0);
}

// The integral over one half of a slice up to a horizon at angle h from the direction to the eye, where the normal is at angle
// n: the paper's eq. 7, with cosines and sines as arguments.
float arc(float h, float cos_h, float sin_h, float cos_n, float sin_n) {
    float cos_difference = (2.0 * cos_h * cos_h - 1.0) * cos_n + 2.0 * sin_h * cos_h * sin_n;  // of 2 h - n
    return 0.25 * (cos_n + 2.0 * h * sin_n - cos_difference);
}
float arc_ahead(float cos_h, float cos_n, float sin_n) {
    return arc(acos(cos_h), cos_h, sqrt(1.0 - cos_h * cos_h), cos_n, sin_n);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = ray_through(vec2(pixel));
    float to_floor = floor_distance(ray), to_body = body_distance(pixel);
    bool is_floor = to_floor < to_body;
    float distance = min(to_floor, to_body);
    vec3 point = ray * distance;
    vec3 normal = is_floor ? floor_plane.xyz : body_normal(point, pixel);
    vec3 to_eye = -normalize(point);
    normal = dot(normal, to_eye) > 0.0 ? normal : to_eye;  // where the depth map was too coarse

    float pixels = min(reach / (ray_step.y * distance), kMostPixels);
    int steps = pixels > 1.0 ? kSteps : 0;
    int index = tile_index(pixel);
    float angle = (float(index) + 0.5) / 16.0 * (kPi / float(kSlices));
    vec2 direction = vec2(cos(angle), sin(angle));
    float shift = fract(float(index) * 0.61803399 + 0.25);
    float open = 0.0, all = 0.0;
    for (int i = 0; i < kSlices; ++i) {
        // The slice contains the direction to the eye and this one, which is perpendicular to it.
        vec3 side = normalize(vec3(direction, 0.0) - dot(direction, to_eye.xy) * to_eye);
        vec2 in_slice = vec2(dot(normal, to_eye), dot(normal, side));
        float part = max(length(in_slice), 1e-6);
        float cos_n = min(in_slice.x / part, 1.0), sin_n = in_slice.y / part;
        // A surface sees nothing below its own tangent plane.
        float ahead = find_horizon(point, normal, to_eye, pixel, direction, pixels, shift, -sin_n, steps);
        float behind = find_horizon(point, normal, to_eye, pixel, -direction, pixels, shift, sin_n, steps);
        open += part * (arc_ahead(ahead, cos_n, sin_n) + arc_ahead(behind, cos_n, -sin_n));
        all += part * (cos_n + abs(sin_n) * acos(cos_n));
        direction = kNextSlice * direction;
    }
    float openness = clamp(open / all, 0.0, 1.0);
    distance = min(distance, kFarthest);
    occlusion = vec2(openness, is_floor ? -distance : distance);
}
