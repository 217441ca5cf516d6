// Pulls and forces that act on nodes from outside (gelatin/pull.h). CPU twin: gelatin::cpu::Pulls.
uniform samplerBuffer pulls;  // by node: place of a spring [m], its stiffness [N/m], 0: none; force [N], damping time [s]
uniform uint is_pulled;       // 0: nothing acts, and pulls is not read

// The force [N] over a step of h seconds. That of the spring is as implicit Euler has it for this node on its spring alone:
// light nodes on strong springs stay stable in explicit schemes too.
vec3 pull_force(uint node, vec3 position, vec3 velocity, float inverse_mass, float h) {
    vec4 spring = texelFetch(pulls, 2 * int(node)), force = texelFetch(pulls, 2 * int(node) + 1);
    float time = h + force.w;
    vec3 offset = spring.xyz - position;
    return force.xyz + spring.w / (1.0 + spring.w * inverse_mass * h * time) * (offset - time * velocity);
}

// For block descent: the target of a node [m] and its weight [N/m] with the spring's own and the force, as of a step of h
// seconds from `start`. A damped spring pulls as a stiffer one to a place between the hand's and the start.
vec4 with_pull(uint node, vec4 target, vec3 start, float h) {
    vec4 spring = texelFetch(pulls, 2 * int(node)), force = texelFetch(pulls, 2 * int(node) + 1);
    float damping = force.w / h, stiffness = spring.w * (1.0 + damping);
    vec3 place = (spring.xyz + damping * start) / (1.0 + damping);
    float weight = target.w + stiffness;
    return vec4((target.w * target.xyz + stiffness * place + force.xyz) / weight, weight);
}
