// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Of a body what passes from part to part: energies [J], and with whom it goes on. CPU twins: cpu::EnergyAccount, TimeScheme::tie.
struct BodyEnergy {      // 40 bytes
    double elastic;
    double contacts;     // its shares in contacts
    double debt;         // its share in what its island has gained beyond what drove it, and still has
    uint  tied;          // the least body with which it has left a part of forces to later parts
    uint  next_tied;     // the same, once this part is made
    uint  is_whole;      // 1: its momenta go by Euler's scheme in this part, whatever its nodes do
    uint  schemes;       // of bodies that are tied to it: 1: some go by Newmark's, 2: by Euler's, 3: both
};
// What the end of a part does to the velocities of a body's free nodes: v becomes (1 - part) v + velocity + spin x r, and then, by
// impacts, which count as no acceleration, v + bounce + turn x r.
struct BodyChange {      // 96 bytes
    vec4  center;        // of mass where the part ends [m]; w: part
    vec4  velocity;      // [m/s]
    vec4  spin;          // [rad/s]
    vec4  bounce;        // [m/s]
    vec4  turn;          // [rad/s]
    uint  action;        // 0: nothing; 1: the part is made; 2: it is made, and the body stays; 3: what the guard has moved is stopped
    uint  unused_0;
    uint  unused_1;
    uint  unused_2;
};
