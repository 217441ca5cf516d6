// The colliding ones among the faces round a node.
uniform usamplerBuffer node_face_starts;
uniform usamplerBuffer node_faces;

uint count_colliding(uint node, ObjectPair pair) {
    uint end = texelFetch(node_face_starts, int(node) + 1).x;
    uint count = 0u;
    for (uint k = texelFetch(node_face_starts, int(node)).x; k < end; ++k) {
        count += uint(collides(pair, texelFetch(node_faces, int(k)).x));
    }
    return count;
}
