// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Of a body what passes from part to part [J]. CPU twin: cpu::EnergyAccount.
struct BodyEnergy {      // 24 bytes
    double elastic;
    double contacts;     // of its contacts
    double debt;         // what it has gained beyond what drove it, and still has
};
// What the end of a part does to the velocities of a body's free nodes: v becomes (1 - part) v + velocity + spin x r.
struct BodyChange {      // 64 bytes
    vec4  center;        // of mass where the part ends [m]; w: part
    vec4  velocity;      // [m/s]
    vec4  spin;          // [rad/s]
    uint  action;        // 0: nothing; 1: the part is made; 2: it is made, and the body stays; 3: what the guard has moved is stopped
    uint  unused_0;
    uint  unused_1;
    uint  unused_2;
};
