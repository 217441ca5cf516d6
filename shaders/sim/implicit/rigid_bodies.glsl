// Bodies of islands of any size: their arms and inverses are in buffers.
uniform samplerBuffer arms;  // of both sides of each row [m]
layout(std430) buffer Inverses { BodyInverse body_inverses[]; };

vec3 arm_at(uint r, uint side) { return texelFetch(arms, int(2u * r + side)).xyz; }
uint body(uint k) { return texelFetch(island_bodies, int(k)).x; }
void keep_inverse(uint k, BodyInverse inverse_) { body_inverses[body(k)] = inverse_; }
