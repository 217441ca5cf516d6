// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// What the guard of pairs finds.
struct GuardState {      // 16 bytes
    uint  is_changed;    // 1: in this part it has moved nodes
    uint  needs_again;   // 1: nodes end beside their paths, or something is blocked: pairs are found anew, and it runs again
    uint  clipped;       // pairs of this run
    uint  is_given_up;   // 1: it has found no way, and all nodes stay where they were
};
// What it knows of a node.
struct NodeClips {       // 8 bytes
    uint  rounds;        // bit r: it is placed in round r; the last bit: it stays where it is in the frame
    uint  first;         // of its half spaces, or kNone
};
