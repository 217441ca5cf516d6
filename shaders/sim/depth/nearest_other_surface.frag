// The nearest depth in a pixel of any surface that is not of the object with the nearest one.
#include "sim/depth/footprint_pixel.glsl"

uniform usampler2D nearest_object;

void main() {
    uint nearest = texelFetch(nearest_object, ivec2(gl_FragCoord.xy), 0).x;
    if (!covers_pixel() || footprint.object == nearest) discard;
    gl_FragDepth = least_depth();
}
