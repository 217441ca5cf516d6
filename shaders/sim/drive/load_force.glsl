// What loads pull at a node [N]; for programs of scenes that have any (LOADED).
#ifdef LOADED
uniform samplerBuffer load_forces;

vec3 load_force(uint node) { return texelFetch(load_forces, int(node)).xyz; }
#endif
