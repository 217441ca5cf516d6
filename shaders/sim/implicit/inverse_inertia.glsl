// Of an object whose nodes have the inertia m / h^2, about its centre [1/(N m)]; 0 if a node is held. To be included after `bodies`.
mat3 inverse_inertia_of(uint object) {
    vec3 d = texelFetch(bodies, 5 * int(object) + 1).xyz, b = texelFetch(bodies, 5 * int(object) + 2).xyz;
    return mat3(d.x, b.z, b.y, b.z, d.y, b.x, b.y, b.x, d.z);
}
