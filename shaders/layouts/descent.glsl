// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A tet as one of its corners sees it; one RGBA32UI texel. Padded with tet 0xFFFFFFFF.
struct TetCorner {       // 16 bytes
    uint  a;             // the other corners, counter-clockwise as this one sees them
    uint  b;
    uint  c;
    uint  tet;
};
// A row of nodes by colour, in slices of 64.
struct DescentRow {      // 16 bytes
    uint  node;          // 0xFFFFFFFF pads a colour
    uint  object;
    uint  pairs;         // of half springs, in the slice from its start on, 64 apart
    uint  place;         // of the node among those of the surface, or 0xFFFFFFFF
};
// How a collider holds a node.
struct ColliderContact { // 32 bytes
    vec4  force;         // [N]; w: how it falls as the body comes away from the surface [N/m], 0 without a contact
    vec4  normal;        // unit; w: how it falls as the body slides [N/m]
};
// x becomes x + translation + rotation (x - center), rotation being less the identity: what a motion adds is small, and
// rounded as such.
struct RigidMotion {     // 80 bytes
    vec4  center;        // [m]; w: 1 if the body moves, else 0
    vec4  translation;   // [m]
    vec4  rotation_x;    // columns
    vec4  rotation_y;
    vec4  rotation_z;
};
