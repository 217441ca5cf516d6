// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Where a surface node may go until the next aim, and where it has its planes and shares.
struct NodeLimits {      // 80 bytes
    vec4  aimed_at;      // [m]; w: square of how far it may go from there in any direction, < 0: look [m^2]
    vec4  room;          // where its way begins [m]; w: how far it may be from its way [m]
    vec4  way;           // [m]; w: 0 if it has to stand still, else 1
    vec4  own_room;      // where its body's map has it [m]; w: how far it may be from there [m]
    uint  first_plane;
    uint  plane_count;
    uint  first_share;
    uint  share_count;
};
// Its part of a contact: gelatin::cpu::ContactShare.
struct NodeShare {       // 48 bytes
    vec4  towards;       // m, unit; w: the gap where it was aimed [m]
    vec4  law;           // 1 / s; k [N/m]; r [m]; Coulomb's coefficient
    vec4  hold;          // q_0 [N]; w: L [N]
};
