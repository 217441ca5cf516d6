// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// An object at rest: the inverse of the sum of m X X^T over its nodes, at X from their centre of mass. Symmetric.
struct RestMoment {      // 48 bytes
    vec4  inverse_x;     // columns [1 / (kg m^2)]; w: mass of the object [kg]
    vec4  inverse_y;     // w: more of its tets must be inside out than this for its shape to be lost
    vec4  inverse_z;
};
// Sums over nodes at x from the object's first one.
struct ShapeSums {       // 80 bytes
    vec4  column_x;      // of m x X^T [kg m^2]; w: m x [kg m]
    vec4  column_y;
    vec4  column_z;
    vec4  momentum;      // m v [kg m/s]; w: m |x|^2 [kg m^2]
    vec4  spin;          // m x cross v [kg m^2/s]
};
// A rigid placement of the shape at rest, center + rotation X, and how it moves.
struct ShapePlace {      // 96 bytes
    vec4  center;        // [m]; w: 1 if the object is put there, else 0
    vec4  rotation_x;    // columns
    vec4  rotation_y;
    vec4  rotation_z;
    vec4  velocity;      // of the center [m/s]
    vec4  spin;          // [1/s]
};
