// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A run of nodes or faces of one object that one work group sums up, and what comes out for nodes.
struct Chunk {           // 16 bytes
    uint  object;
    uint  first;
    uint  count;         // 1 .. 256
    uint  origin;        // a node of the object: volumes are taken about it
};
struct NodeSums {        // 32 bytes
    float momentum_x;    // [kg m/s]
    float momentum_y;
    float momentum_z;
    float kinetic_energy;    // [J]
    float elastic_energy;    // [J], half of each incident spring's
    float potential_energy;  // [J]
    float deepest;           // how far the deepest node is inside a collider [m], >= 0
    uint  contacts;          // nodes that touch a collider
};
