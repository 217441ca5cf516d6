// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A surface node and a face, or two surface edges, that may come nearer than their reach in a part of a step, and where they are
// near each other when it begins. CPU twin: cpu::NearPair.
struct NearPair {        // 80 bytes
    uint  node_0;        // of a node and a face: the node, the corners; of two edges: their ends
    uint  node_1;
    uint  node_2;
    uint  node_3;
    vec4  weights;       // of the nodes in the nearest points
    vec4  normal;        // from the first side's nearest point to the second's, unit; 0 if these are the same; w: their distance [m]
    uint  first;         // node, or edge
    uint  second;        // face, or edge
    uint  is_edges;      // 1: two edges
    uint  slot;          // PairSlot
    uint  object;        // of the sides
    uint  other;
    float reach;         // [m]
    float rounding;      // bound of what rounding makes of a difference of heights along the normal [m]
};
// An object and another one that is near it, or itself. Two objects have two slots, one in either's list: in each the first object's
// nodes are near the other's faces. Of their edges only the slot of the lesser object has pairs.
struct PairSlot {        // 16 bytes
    uint  object;
    uint  other;
    uint  first_pair;    // NearPair
    uint  pair_end;
};
// How many there are in a part, with a place or without one.
struct PairCounts {      // 32 bytes
    uint  slots;
    uint  searches;      // leaves of trees that search another object
    uint  leaf_pairs;
    uint  pairs;         // NearPairs
    float fastest;       // cpu::FindPairs::fastest_approach [reaches]
    uint  is_full;       // 1: some had no place
    uint  has_lost;      // 1: there may be self-contact where no pairs were searched
    uint  unused_1;
};
// What a contact of two objects passes on to the next part.
struct RowMemory {       // 32 bytes
    vec4  hold;          // of friction [N]; w: most that friction holds with [N]
    float reach;         // [m]
    uint  first;         // node, or edge
    uint  second;        // of a node the other object; of an edge the other edge
    uint  is_edges;
};
