// The start of a step and where it leads without springs: what start_descent.comp has written.
uniform samplerBuffer start_positions;   // xyz [m], inverse mass [1/kg]
uniform samplerBuffer start_velocities;  // xyz [m/s], damping time [s]
uniform samplerBuffer targets;          // y [m], m / h^2 [N/m], 0 where a node is held
uniform float time_step;                                     // h [s]

vec3 target_of(uint node) { return texelFetch(targets, int(node)).xyz; }
