// Forces of the volume term for explicit solvers, after sim/elasticity/find_volume_stresses.comp. CPU twin:
// cpu::gather_volume_forces.
#include "sim/elasticity/volume_stresses.glsl"
#include "sim/elasticity/volume_term.glsl"

// The force on node n [N]: each tet of volume v acts with -p dv/dx, p the mean stress of its corners. The forces of
// neo-Hookean tets have theirs in them.
vec3 gather_volume_forces(uint n) {
#ifdef NEO_HOOKEAN
    if (has_neo_hookean_tets(n)) return vec3(0.0);
#endif
    float own = texelFetch(volume_stresses, int(n)).x;
    vec3 at = texelFetch(positions, int(n)).xyz;
    vec3 sum = vec3(0.0);  // -24 times the force
    Strip strip = kNoStrip;
    vec3 stresses = vec3(0.0);
    uint end = texelFetch(volume_starts, int(n / kSlice) + 1).x;
    for (uint e = texelFetch(volume_starts, int(n / kSlice)).x + n % kSlice; e < end; e += kSlice) {
        uvec4 volume_step = texelFetch(volume_strips, int(e));
        if (volume_step.x == kNone) break;
        int node = node_of(volume_step.x);
        step_strip(volume_step.x, texelFetch(positions, node).xyz - at, strip);
        step_numbers(volume_step.x, texelFetch(volume_stresses, node).x, stresses);
        sum += (own + sum_of(stresses)) * area_of(volume_step, strip);
    }
    return -sum / 24.0;
}
