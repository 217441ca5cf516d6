// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A contact in a step: s = sum_k w_k d_k is by how much its sides move relative to each other. CPU twin: cpu::ContactRow.
struct StepRow {         // 96 bytes
    uint  node_0;
    uint  node_1;
    uint  node_2;
    uint  node_3;
    vec4  weights;       // 0 where there is no node
    vec4  normal;        // from the first side to the second, unit; w: gap when the step begins [m]
    float reach;         // [m]
    float stiffness;     // [N/m]
    float damping;       // [N/m]
    float friction;
    vec4  hold;          // of friction, when the step begins [N]; w: most that friction holds with [N]
    uint  object;        // of the sides; in a table: the number of objects for what rigid motions do not move
    uint  other;
    uint  plane;         // the collider, where it is the first side
    float ease;          // of the gap: what a plane has not yet pushed out [m]
};
// The force of a row to first order: constant - stiffness s.
struct StepTangent {     // 48 bytes
    vec4  constant;      // [N]
    vec4  diagonal;      // of the stiffness: xx, yy, zz [N/m]
    vec4  beside;        // yz, zx, xy
};
// Rows of two objects, by chunks of at most kRowsOfChunk.
struct StepPair {        // 16 bytes
    uint  object;        // as in a row
    uint  other;
    uint  first_chunk;
    uint  chunk_end;
};
// What an island has in the tables: bodies, chunks of their nodes, rows, chunks of rows, pairs.
struct StepIsland {      // 48 bytes
    uint  first_body;
    uint  body_end;
    uint  first_chunk;
    uint  chunk_end;
    uint  first_row;
    uint  row_end;
    uint  first_row_chunk;
    uint  row_chunk_end;
    uint  first_pair;
    uint  pair_end;
    uint  unused_0;
    uint  unused_1;
};
