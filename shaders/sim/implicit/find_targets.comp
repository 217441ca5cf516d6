// What inertia and hands want of each node: the displacement, and what they resist others with; and damping times. By chunk the
// energy of motion, of which a solve may miss a part. A work group a chunk.
// CPU twin: gelatin::cpu::ImplicitStep::find_targets, gelatin::cpu::ImplicitStep::linearise.
// Parity: tests/gpu/implicit/part_start_test.cpp.
const uint kLanes = 64u;
#include "layouts/contact_tuning.glsl"
#include "sim/drive/pull.glsl"
#include "sim/implicit/acceleration.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/node_chunks.glsl"
#include "sim/implicit/time_scheme.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;      // xyz [m]; w: inverse mass, 0: held
uniform samplerBuffer velocities;     // xyz [m/s]; w: damping time [s]
uniform samplerBuffer masses;         // [kg]
uniform samplerBuffer predicted;      // displacements of held nodes [m]
uniform samplerBuffer accelerations;  // a_0 [m/s^2]
uniform samplerBuffer paces;          // BodyPace, five texels each
uniform uint body_count;
layout(std430) writeonly buffer Loads { vec4 loads[]; };                  // w: m / h'^2 [N/m]
layout(std430) writeonly buffer Displacements { vec4 displacements[]; };  // [m]
layout(std430) writeonly buffer DampingTimes { float damping_times[]; };  // [s]
layout(std430) writeonly buffer Energies { float energies[]; };           // by chunk [J]

// A hand pulls like inertia does, to a place of its own.
vec4 pulled(uint n, vec4 wanted, vec3 x) {
    vec4 spring = texelFetch(pulls, 2 * int(n)), force = texelFetch(pulls, 2 * int(n) + 1);
    if (spring.w == 0.0 && force.xyz == vec3(0.0)) return wanted;
    vec4 both = with_pull(n, vec4(x + wanted.xyz, wanted.w), x, clock[0].step);
    return vec4(both.xyz - x, both.w);
}

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    Scheme scheme = scheme_of(clock[0].step, 0.0);
    vec3 motion = vec3(0.0);  // of the body as a whole [m/s]
    float damping = 0.0, energy = 0.0;
    if (chunk.x < body_count) {
        vec4 pace = texelFetch(paces, 5 * int(chunk.x) + 1);
        scheme = scheme_of(clock[0].step, pace.x);
        damping = pace.y;
        motion = texelFetch(paces, 5 * int(chunk.x) + 2).xyz;
    }
    float fall = kHardly * clock[0].step * length(gravity), rounding = kRoundings * 1.1920929e-7 / clock[0].step;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += kLanes) {
        vec4 x = texelFetch(positions, int(n)), v = texelFetch(velocities, int(n));
        vec4 wanted = vec4(texelFetch(predicted, int(n)).xyz, 0.0);
        if (x.w > 0.0) {
            wanted.xyz = target_by(scheme, v.xyz, acceleration(n, x.w), texelFetch(accelerations, int(n)).xyz);
            wanted.w = 1.0 / (x.w * inner_size(scheme) * inner_size(scheme));
            if (is_pulled != 0u) wanted = pulled(n, wanted, x.xyz);
        }
        loads[n] = vec4(0.0, 0.0, 0.0, wanted.w);
        displacements[n] = vec4(wanted.xyz, 0.0);
        damping_times[n] = max(v.w, damping);
        vec3 own = v.xyz - motion;
        energy += 0.5 * texelFetch(masses, int(n)).x *
                  (dot(own, own) + fall * fall + rounding * rounding * dot(x.xyz, x.xyz));
    }
    energy = sum_over_group(energy);
    if (lane == 0u) energies[c] = energy;
}
