// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
struct Collider {        // 64 bytes
    vec4  center;        // [m] xyz; plane: its unit normal. w: radius [m]; plane: its offset [m]
    vec4  axis;          // capsule: half its straight part, as a vector [m]; box: half extents [m]
    vec4  orientation;   // box: unit quaternion (x, y, z, w) from its own axes to the world's
    uint  kind;          // 0 plane, 1 box, 2 sphere, 3 capsule
    float friction;      // Coulomb's coefficient, >= 0
    float restitution;   // in [0, 1]
    uint  unused;
};
