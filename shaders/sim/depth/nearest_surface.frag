// The nearest depth of any surface in a pixel, and its object.
#include "sim/depth/footprint_pixel.glsl"

layout(location = 0) out uint nearest_object;

void main() {
    if (!covers_pixel()) discard;
    nearest_object = footprint.object;
    gl_FragDepth = least_depth();
}
