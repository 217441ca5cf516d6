// Forces of the volume term where explicit solvers need them, after sim/explicit/find_volume_stresses.comp. CPU twin:
// cpu::gather_volume_forces.
#include "sim/elasticity/volume_term.glsl"

uniform samplerBuffer volume_stresses;  // [Pa], of each node

// On node n [N]: each tet of volume v pulls with -p dv/dx, p the mean stress of its corners.
vec3 gather_volume_forces(uint n) {
    float own = texelFetch(volume_stresses, int(n)).x;
    vec3 sum = vec3(0.0);  // -24 times the force
    uint end = texelFetch(volume_starts, int(n / kSlice) + 1).x;
    for (uint e = texelFetch(volume_starts, int(n / kSlice)).x + n % kSlice; e < end; e += kSlice) {
        uvec4 tet = texelFetch(volume_corners, int(e));
        vec3 a = texelFetch(positions, int(tet.x)).xyz;
        vec3 b = texelFetch(positions, int(tet.y)).xyz, c = texelFetch(positions, int(tet.z)).xyz;
        float p = own + texelFetch(volume_stresses, int(tet.x)).x + texelFetch(volume_stresses, int(tet.y)).x +
                  texelFetch(volume_stresses, int(tet.z)).x;
        sum += p * cross(b - a, c - a);
    }
    return -sum / 24.0;
}
