// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A tet as one of its corners sees it; one RGBA32UI texel. Padded with tet 0xFFFFFFFF.
struct TetCorner {       // 16 bytes
    uint  a;             // the other corners, counter-clockwise as this one sees them
    uint  b;
    uint  c;
    uint  tet;
};
// Sums over nodes at r from an origin that have a way d to go, of mass m.
struct RigidSums {       // 80 bytes
    vec4  arm;           // m r [kg m]; w: m [kg]
    vec4  way;           // m d [kg m]; w: number of nodes that are held
    vec4  moment;        // m r x d [kg m^2]
    vec4  square;        // m r_x r_x, m r_y r_y, m r_z r_z [kg m^2]
    vec4  product;       // m r_y r_z, m r_z r_x, m r_x r_y [kg m^2]
};
// x becomes center + shift + turn (x - center).
struct RigidMotion {     // 80 bytes
    vec4  center;        // [m]; w: 1 if the body moves, else 0
    vec4  shift;         // [m]
    vec4  turn_x;        // columns
    vec4  turn_y;
    vec4  turn_z;
};
