// The nearest depth in a pixel of any surface of another object than the one with the nearest depth.
#include "sim/depth/footprint_pixel.glsl"

uniform usampler2D nearest_object;

void main() {
    uint nearest = texelFetch(nearest_object, ivec2(gl_FragCoord.xy), 0).x;
    if (!covers_pixel() || footprint.object == nearest) discard;
    gl_FragDepth = least_depth();
}
