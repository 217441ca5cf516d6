// What tets exert where a part of a step begins, one invocation a tet. Of tets of springs, of each corner sqrt(k) dJ/dx with the
// tet's stiffness k [J] against changes of J; minus its product with w is the force. Neo-Hookean: minus the force, and 1.
// CPU twin: gelatin::cpu::ElasticSystem. Parity: tests/gpu/implicit/elastic_system_test.cpp.
#include "include/global_index.glsl"
#include "sim/implicit/tets.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer TetRows { vec4 tet_rows[]; };  // four a tet
uniform uint tet_count;

void write_rows(uint t, vec3 one, vec3 two, vec3 three, float w) {
    tet_rows[4u * t] = vec4(-(one + two + three), w);
    tet_rows[4u * t + 1u] = vec4(one, w);
    tet_rows[4u * t + 2u] = vec4(two, w);
    tet_rows[4u * t + 3u] = vec4(three, w);
}

void main() {
    uint t = global_index();
    if (t >= tet_count) return;
    uvec4 tet = texelFetch(tets, int(t));
    vec4 rest = texelFetch(tet_rests, int(t));
    float pressure = volume_pressure(tet, rest.x);
#ifdef NEO_HOOKEAN
    uint number = texelFetch(neo_hookean_numbers, int(t)).x;
    if (number != kNone) {
        NeoHookeanTet element = fetch_neo_hookean(number, tet);
        mat3 stress = element.shear * element.gradient + (element.pressure + pressure) * element.cofactors;
        vec3 forces[3];
        for (int c = 0; c < 3; ++c) {
            vec3 g = element.gradients[c + 1];
            forces[c] = stress * g - (element.squares < kCollapsed ? element.mu : 0.0) * g;
        }
        write_rows(t, forces[0], forces[1], forces[2], 1.0);
        return;
    }
#endif
    mat3 sides = sides_of(tet);
    float inverse = 1.0 / (6.0 * rest.x);
    vec3 one = inverse * cross(sides[1], sides[2]), two = inverse * cross(sides[2], sides[0]),
         three = inverse * cross(sides[0], sides[1]);
    float lack = kFlattest - dot(sides[0], one);
    float flat_stiffness = lack > 0.0 ? rest.x * rest.y : 0.0;
    float stiffness = flat_stiffness + rest.x * rest.z, root = sqrt(stiffness);
    write_rows(t, root * one, root * two, root * three,
               stiffness > 0.0 ? (pressure - flat_stiffness * lack) / root : 0.0);
}
