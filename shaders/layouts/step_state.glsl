// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// How far a step is, which is made in parts. Each is tried, and tried again where that was too long; no try begins after the step is
// made, and what is left of a try that is given up does nothing.
struct StepClock {       // 80 bytes
    float size;          // of the step [s]
    float left;          // of it [s]
    float longest;       // that a part may be [s]
    float step;          // h: of this part [s]
    float last_step;     // of the part before; 0: there is none, nodes were set from outside [s]
    float gained;        // what an island has gained by this part, beyond what drives it, as a part of its energy; the most
    uint  is_over;       // 1: the step is made
    uint  goes_on;       // 1: this try does
    uint  damps;         // 1: all bodies go by implicit Euler's scheme
    uint  has_past;      // 1: any goes by another
    uint  divides;       // 1: steps are divided where bodies touch others
    uint  parts;         // into how many at least, by what the part before found
    uint  tries;         // of this step
    uint  made;          // parts of this step
    uint  is_guarded;    // 1: the guard has moved nodes
    uint  row_count;
    uint  dropped_rows;  // for which there was no place
    uint  begun;         // parts of this step of which a try has begun
    uint  guards;        // how often the guard has run in this part; above 0 the try goes on with it alone
    uint  is_full;       // 1: a buffer was full; nothing goes on until the host has given more
};
// What a body passes on from part to part, and what its part begins with.
struct BodyPace {        // 80 bytes
    uint  pace;          // as in cpu::Paces: 0 moving, 1 calm, 2 still
    uint  is_struck;     // 1: it makes its next part by Euler's scheme
    uint  held_count;    // of its nodes, where the last part began
    uint  is_held;       // 1: planes, held nodes or forces act on it in this part
    float past;          // this part's scheme: 1: Newmark's, 0: Euler's
    float damping;       // its least damping time [s]
    uint  first_row;     // of this part
    uint  row_end;
    vec4  velocity;      // of what its nodes have in common where the part begins [m/s]; w: mass [kg]
    vec4  force;         // by which momentum changed in the last part [N]
    vec4  moment;        // and angular momentum [N m]
};
// What a contact with a plane passes on to the next part.
struct PlaneMemory {     // 32 bytes
    vec4  hold;          // of friction [N]; w: most that friction holds with [N]
    float reach;         // [m]; 0: there was no contact
    float ease;          // [m]
    float unused_0;
    float unused_1;
};
// Sums over a chunk's nodes where a part begins.
struct StartSums {       // 48 bytes
    vec4  momentum;      // [kg m/s]; w: mass [kg]
    vec4  carried;       // of held nodes alone
    float held_count;
    float unused_0;
    float unused_1;
    float unused_2;
};
// The contacts with planes of a chunk of nodes.
struct ChunkRows {       // 16 bytes
    uint  count;
    uint  first;         // of those of its object
    float nearest;       // least gap of those that the part before had, as a part of the reach; at most 1
    float deepest;       // how far they would come inside without forces, in reaches
};
// And of a body.
struct BodyRows {        // 16 bytes
    uint  count;
    uint  unused;
    float nearest;
    float deepest;
};
