// The footprint at this fragment's pixel.
#define FOOTPRINT in
#include "sim/depth/footprint.glsl"

bool covers_pixel() {
    vec3 center = vec3(gl_FragCoord.xy, 1.0);
    return dot(footprint.edges[0], center) >= 0.0 && dot(footprint.edges[1], center) >= 0.0 &&
           dot(footprint.edges[2], center) >= 0.0;
}

float depth_at_center() {
    return footprint.corner.z + dot(footprint.slope, gl_FragCoord.xy - footprint.corner.xy);
}
float least_depth() { return max(depth_at_center() - footprint.depth_reach, footprint.depth_range.x); }
float greatest_depth() { return min(depth_at_center() + footprint.depth_reach, footprint.depth_range.y); }
