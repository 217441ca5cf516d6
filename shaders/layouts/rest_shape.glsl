// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// How an object's nodes lie about their middle at rest. The matrix is symmetric: the inverse of the sum of X X^T over
// all nodes at X from the middle.
struct RestShape {       // 48 bytes
    vec4  inverse_moment_x;  // [1/m^2]; w: length of the object [m]
    vec4  inverse_moment_y;  // w: least clearance of its faces [m]
    vec4  inverse_moment_z;
};
// Sums over a chunk's nodes, of positions x from the chunk's origin: x X^T by columns; w: x itself.
struct FitSums {         // 48 bytes
    vec4  column_x;      // [m^2]; w: [m]
    vec4  column_y;
    vec4  column_z;
};
// The affine map of the rest shape that comes nearest to an object, x = center + map X.
struct AffineFit {       // 80 bytes
    vec4  column_x;      // of the map; w: half of the least that it stretches anything
    vec4  column_y;      // w: error that rounding may make of a distance [m]
    vec4  column_z;      // w: no face is restless while all nodes are nearer to where the map puts them than this [m]
    vec4  center;        // [m]; w: sizes of the object, at rest and then, that rounding grows with [m]
    vec4  origin;        // where the object's first node was [m]
};
