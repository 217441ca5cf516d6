// Nodes that a hand holds (gelatin/pull.h). CPU twin: gelatin::cpu::Pulls.
uniform samplerBuffer pulls;  // by node: its place from the target [m], stiffness [N/m]; 0: not held
uniform uint is_pulled;       // 0: a hand holds nothing, and pulls is not read
uniform vec3 pull_target;                          // [m]
uniform float pull_damping_time;                   // damping over stiffness [s]

// The force [N] over a step of h seconds, as implicit Euler has it for this node on its spring alone: light nodes on
// strong springs stay stable in explicit schemes too.
vec3 pull_force(uint node, vec3 position, vec3 velocity, float inverse_mass, float h) {
    vec4 pull = texelFetch(pulls, int(node));
    float time = h + pull_damping_time;
    vec3 offset = pull_target + pull.xyz - position;
    return pull.w / (1.0 + pull.w * inverse_mass * h * time) * (offset - time * velocity);
}

// For block descent: the target of a node [m] and its weight [N/m] with the spring's own beside them, as of a step of h
// seconds from `start`. A damped spring pulls as a stiffer one to a place between the hand's and the start.
vec4 with_pull(uint node, vec4 target, vec3 start, float h) {
    vec4 pull = texelFetch(pulls, int(node));
    float damping = pull_damping_time / h, stiffness = pull.w * (1.0 + damping);
    vec3 place = (pull_target + pull.xyz + damping * start) / (1.0 + damping);
    float weight = target.w + stiffness;
    return vec4((target.w * target.xyz + stiffness * place) / weight, weight);
}
