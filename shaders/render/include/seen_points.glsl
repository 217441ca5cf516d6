// What each pixel of a small picture shows: points in the eye's coordinates, from a depth map of the bodies and the
// plane of the floor.
uniform sampler2D body_depths;
uniform vec2 ray_step;     // from pixel to pixel of the map, 1 m before the eye [m]
uniform vec2 first_ray;    // through the centre of the first one
uniform vec2 depth_terms;  // of the projection: distance [m] = depth_terms.x / (depth_terms.y + depth)
uniform vec4 floor_plane;  // unit normal and height of the eye over it [m]; 0 0 0 1: no floor

const float kFarAway = 1e6;

// Through the pixel, 1 m along the axis of the view.
vec3 ray_through(vec2 pixel) { return vec3(pixel * ray_step + first_ray, -1.0); }

// Along the axis of the view [m].
float floor_distance(vec3 ray) { return floor_plane.w / max(-dot(floor_plane.xyz, ray), 1.0 / kFarAway); }

float body_distance(ivec2 pixel) {
    float depth = texelFetch(body_depths, pixel, 0).r;
    return depth < 1.0 ? depth_terms.x / (depth_terms.y + depth) : kFarAway;
}

vec3 body_point(ivec2 pixel) { return ray_through(vec2(pixel)) * body_distance(pixel); }
