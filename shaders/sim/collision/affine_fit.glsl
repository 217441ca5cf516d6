// How far nodes are from where their object's affine map puts them.
#include "layouts/rest_shape.glsl"

uniform samplerBuffer positions;     // xyz [m]
uniform samplerBuffer rest_offsets;  // xyz [m]
uniform samplerBuffer fits;          // AffineFit

AffineFit fetch_fit(uint object) {
    int first = 5 * int(object);
    return AffineFit(texelFetch(fits, first), texelFetch(fits, first + 1), texelFetch(fits, first + 2),
                     texelFetch(fits, first + 3), texelFetch(fits, first + 4));
}

vec3 position(uint node) { return texelFetch(positions, int(node)).xyz; }

// [m] @param offset of the node, which is `node`, from the map's center
float deviation(AffineFit fit, uint node, vec3 offset) {
    vec3 rest = texelFetch(rest_offsets, int(node)).xyz;
    return distance(offset, fit.column_x.xyz * rest.x + fit.column_y.xyz * rest.y + fit.column_z.xyz * rest.z);
}
