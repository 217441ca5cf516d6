// What rows exert on nodes. Without ROWS there are none.
#ifdef ROWS
#include "sim/implicit/row_list.glsl"
#include "sim/implicit/rows.glsl"
uniform usamplerBuffer entry_starts;  // of each node, and the end
uniform usamplerBuffer row_entries;   // 4 row + place of the node in it

#ifdef MAKES_TANGENTS
RowStiffness row_stiffness(uint r);  // of a kernel
#else
uniform samplerBuffer tangents;  // StepTangent, three texels each

RowStiffness row_stiffness(uint r) {
    return RowStiffness(texelFetch(tangents, 3 * int(r) + 1).xyz, texelFetch(tangents, 3 * int(r) + 2).xyz);
}
#endif

vec3 row_value(uint r, StepRow row);  // a force on the second side, of a kernel

vec3 sum_of_rows(uint n) {
    vec3 sum = vec3(0.0);
    uint end = texelFetch(entry_starts, int(n) + 1).x;
    for (uint e = texelFetch(entry_starts, int(n)).x; e < end; ++e) {
        uint entry = texelFetch(row_entries, int(e)).x;
        StepRow row = rows[entry / 4u];
        sum += row.weights[entry % 4u] * row_value(entry / 4u, row);
    }
    return sum;
}
#else
vec3 sum_of_rows(uint n) { return vec3(0.0); }
#endif
