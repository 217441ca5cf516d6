// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// What rows of near pairs are made of (gpu::PairRows).
// The row of a NearPair.
struct PairWeight {      // 32 bytes
    float stiffness;     // [N/m]; 0: it has none
    float reach;         // that it has in all [m]
    float known_reach;   // that it had in the part before, as far as the gap allows more [m]; 0: it is new
    float there;         // its gap without forces of elements and contacts [m]
    uint  memory;        // RowMemory, if it is known
    uint  place;         // among the rows of its slot
    uint  unused_0;
    uint  unused_1;
};
// The rows of a PairSlot.
struct SlotRows {        // 16 bytes
    uint  count;
    uint  twin;          // the slot of the same objects the other way round; kNone: there is none
    float nearest;       // least gap of those that the part before had, as a part of the reach; at most 1
    float deepest;       // how far they would come into each other without forces, in reaches
};
// Where the rows of a slot, or of a body with planes, are in the tables.
struct RowPlace {        // 16 bytes
    uint  first_row;
    uint  row_end;
    uint  first_chunk;   // of rows
    uint  pair;          // StepPair
};
// What a body touches. Its own are the slots in its list, those of colliders with it, and planes.
struct BodyTouch {       // 32 bytes
    uint  rows;          // of its own
    uint  pairs;         // of those, that have rows
    uint  row_chunks;
    uint  couplings;     // pairs of which it is one of two sides
    uint  plane_rows;
    uint  is_driven;     // 1: it touches what is no body
    float deepest;       // as in SlotRows
    uint  unused;
};
// Where its own begin in the tables.
struct BodyPlace {       // 16 bytes
    uint  row;
    uint  pair;
    uint  row_chunk;
    uint  node_chunk;
};
