// The bodies of islands. One without an island, which nothing but its held nodes moves, counts as one by itself. To be included after
// sim/implicit/solve_system.glsl.
struct IslandBodies {
    uint first, end;  // in island_bodies
    uint alone;       // the body of no island; kNone: there are several, or it has one
};

IslandBodies bodies_beside(uint o) {
    uint number = texelFetch(island_of_object, int(o)).x;
    if (number == kNone) return IslandBodies(0u, 1u, o);
    uvec4 island = texelFetch(islands, 3 * int(number));
    return IslandBodies(island.x, island.y, kNone);
}

uint body_at(IslandBodies island, uint k) { return island.alone == kNone ? texelFetch(island_bodies, int(k)).x : island.alone; }

uint first_body(IslandBodies island) { return body_at(island, island.first); }
