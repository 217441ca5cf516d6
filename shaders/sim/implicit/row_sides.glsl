// The sides of a row, by its nodes: weights of the first are negative. To be included after sim/implicit/rows.glsl.
// CPU twin: gelatin::cpu::ContactRow.
uniform samplerBuffer node_objects;  // of each node: velocity of its object's surface within itself [m/s]; w: the object

bool has_plane(StepRow row) { return all(greaterThanEqual(row.weights, vec4(0.0))); }

// Whether no other place before has a node of the same side.
bool is_first_of_side(StepRow row, uint place) {
    bool is_first = true;
    for (uint k = 0u; k < place; ++k)
        if (row.weights[k] != 0.0 && (row.weights[k] < 0.0) == (row.weights[place] < 0.0)) is_first = false;
    return is_first;
}

// A node of either side; of a plane that of the other.
uvec2 side_nodes(StepRow row) {
    uvec4 nodes = nodes_of(row);
    uvec2 sides = uvec2(nodes.x);
    for (int k = 0; k < 4; ++k) {
        if (row.weights[k] < 0.0) sides.x = nodes[k];
        if (row.weights[k] > 0.0) sides.y = nodes[k];
    }
    return sides;
}

uint object_of(uint n) { return uint(texelFetch(node_objects, int(n)).w); }
