// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// One side of two objects that touch. A colliding face gives each of its corners a share of the node's mass, so that a
// node's shares over all its colliding faces add up to its mass.
struct ContactPatch {    // 48 bytes
    vec4  area_normal;   // weighted sum of the colliding faces' area normals [m^2]; w: mass of the corners [kg]
    vec4  momentum;      // of the corners [kg m/s]; w: number of corners that are pinned
    vec4  held;          // sum of these' velocities [m/s]
};
// The corners of a patch that move towards the other object.
struct ApproachSums {    // 32 bytes
    vec4  momentum;      // [kg m/s]; w: mass [kg]
    float impulse;       // sum of mass times speed of approach [kg m/s]
    float unused_0;
    float unused_1;
    float unused_2;
};
// What a corner's velocity v changes by: -factor * u * normal + slowing, where u = (v - velocity) . normal > 0.
struct ContactResponse { // 48 bytes
    vec4  normal;        // unit, towards the other object; w: factor
    vec4  velocity;      // of the contact [m/s]
    vec4  slowing;       // by friction [m/s]
};
