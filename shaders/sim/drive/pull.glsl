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

// As of a step of h seconds from `start`, a damped spring pulls as a stiffer one to a place between the hand's and the start.
vec4 damped_pull(uint node, vec3 start, float h) {
    vec4 spring = texelFetch(pulls, 2 * int(node)), force = texelFetch(pulls, 2 * int(node) + 1);
    float damping = force.w / h;
    return vec4((spring.xyz + damping * start) / (1.0 + damping), spring.w * (1.0 + damping));
}

// For implicit steps: the target of a node [m] and its weight [N/m] with the spring's own and the force.
vec4 with_pull(uint node, vec4 target, vec3 start, float h) {
    vec4 force = texelFetch(pulls, 2 * int(node) + 1), hand = damped_pull(node, start, h);
    float weight = target.w + hand.w;
    return vec4((target.w * target.xyz + hand.w * hand.xyz + force.xyz) / weight, weight);
}

// The force [N] on a node that a step of h seconds brought from `start` to `position`.
vec3 pull_force_at_end(uint node, vec3 position, vec3 start, float h) {
    vec4 force = texelFetch(pulls, 2 * int(node) + 1), hand = damped_pull(node, start, h);
    return force.xyz + hand.w * (hand.xyz - position);
}
