// The tets of bodies where a part of a step begins: corners, what they are at rest, the volume term's stress round nodes.
#include "layouts/packing.glsl"
#include "layouts/thresholds.glsl"

uniform samplerBuffer positions;   // xyz [m]
uniform usamplerBuffer tets;       // their corners
uniform samplerBuffer tet_rests;   // V [m^3], modulus against being flat [Pa], stiffness of the volume term [Pa]
#ifdef VOLUME
uniform samplerBuffer volume_stresses;  // [Pa]
#endif
#ifdef NEO_HOOKEAN
uniform usamplerBuffer neo_hookean_numbers;  // of tets among neo-Hookean ones, or kNone
uniform samplerBuffer neo_hookean_tets;      // three texels: gradients of the corners 1, 2, 3 at rest [1/m]; w: V, mu, lambda
#endif

// The corners 1, 2, 3 of a tet, from its corner 0 [m].
mat3 sides_of(uvec4 tet) {
    vec3 origin = texelFetch(positions, int(tet.x)).xyz;
    return mat3(texelFetch(positions, int(tet.y)).xyz - origin, texelFetch(positions, int(tet.z)).xyz - origin,
                texelFetch(positions, int(tet.w)).xyz - origin);
}

// What the volume term adds to the pressure of a tet [J].
float volume_pressure(uvec4 tet, float volume) {
#ifdef VOLUME
    float sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += texelFetch(volume_stresses, int(tet[k])).x;
    return 0.25 * volume * sum;
#else
    return 0.0;
#endif
}

#ifdef NEO_HOOKEAN
// A neo-Hookean tet as sim/elasticity/neo_hookean.glsl has it, with its own gradients.
struct NeoHookeanTet {
    mat4x3 gradients;    // of the corners' shape functions at rest [1/m]
    float mu, lambda;    // times V [J]
    mat3 gradient;       // F
    mat3 cofactors;      // dJ/dF
    float squares;       // I
    float shear;         // factors of F and of its cofactors in the stress, times V [J]
    float pressure;
};

NeoHookeanTet fetch_neo_hookean(uint number, uvec4 tet) {
    int first = int(3u * number);
    vec4 one = texelFetch(neo_hookean_tets, first), two = texelFetch(neo_hookean_tets, first + 1),
         three = texelFetch(neo_hookean_tets, first + 2);
    NeoHookeanTet t;
    t.gradients = mat4x3(-(one.xyz + two.xyz + three.xyz), one.xyz, two.xyz, three.xyz);
    t.mu = one.w * two.w;
    t.lambda = one.w * three.w;
    mat3 sides = sides_of(tet);
    t.gradient = outerProduct(sides[0], one.xyz) + outerProduct(sides[1], two.xyz) + outerProduct(sides[2], three.xyz);
    mat3 f = t.gradient;
    t.cofactors = mat3(cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1]));
    t.squares = dot(f[0], f[0]) + dot(f[1], f[1]) + dot(f[2], f[2]);
    t.shear = t.mu * t.squares / (t.squares + 1.0);
    t.pressure = t.lambda * (dot(f[0], t.cofactors[0]) - 1.0) - 0.75 * t.mu;
    return t;
}
#endif
