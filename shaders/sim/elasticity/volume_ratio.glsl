// A tet's volume relative to that at rest; negative if it is inverted. CPU twin: cpu::volumes_are_within.
uniform samplerBuffer positions;   // xyz [m]
uniform usamplerBuffer tets;       // nodes
uniform samplerBuffer tet_rests;  // volume [m^3], modulus [Pa], stiffness of the volume term [Pa]

float volume_ratio(uint t) {
    uvec4 tet = texelFetch(tets, int(t));
    vec3 a = texelFetch(positions, int(tet.x)).xyz;
    vec3 u = texelFetch(positions, int(tet.y)).xyz - a;
    vec3 v = texelFetch(positions, int(tet.z)).xyz - a;
    vec3 w = texelFetch(positions, int(tet.w)).xyz - a;
    return dot(cross(u, v), w) / (6.0 * texelFetch(tet_rests, int(t)).x);
}
