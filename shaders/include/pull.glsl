// Nodes that a hand holds (gelatin/pull.h); for programs of solvers that were told of one (PULLED).
// CPU twin: gelatin::cpu::Pulls.
#ifdef PULLED
layout(binding = 17) uniform samplerBuffer pulls;  // by node: its place from the target [m], stiffness [N/m]; 0: not held
uniform vec3 pull_target;                          // [m]
uniform float pull_damping_time;                   // damping over stiffness [s]

// The force [N] over a step of h seconds, as implicit Euler has it for this node on its spring alone: light nodes on
// strong springs stay stable in explicit schemes too.
vec3 pull_force(uint node, vec3 position, vec3 velocity, float inverse_mass, float h) {
    vec4 pull = texelFetch(pulls, int(node));
    float time = h + pull_damping_time;
    vec3 way = pull_target + pull.xyz - position;
    return pull.w / (1.0 + pull.w * inverse_mass * h * time) * (way - time * velocity);
}

// For block descent: the force [N] at `position` after a step of h seconds from `start`, and how much it falls with a way
// in its direction [N/m].
vec4 pull_terms(uint node, vec3 position, vec3 start, float h) {
    vec4 pull = texelFetch(pulls, int(node));
    float damping = pull.w * pull_damping_time / h;
    return vec4(pull.w * (pull_target + pull.xyz - position) - damping * (position - start), pull.w + damping);
}
#endif
