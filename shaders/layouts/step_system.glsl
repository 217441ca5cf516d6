// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A body of which no node is held, as a rigid one in the system of a step: its nodes have the inertia m / h^2 [N/m] there.
struct StepBody {        // 80 bytes
    vec4  center;            // xyz [m]; w: 1 over the sum of m / h^2 [m/N], 0 if a node is held
    vec4  inverse_diagonal;  // of its inertia about the centre, inverted: xx, yy, zz [1/(N m)]; w: energy that may be missing [J]
    vec4  inverse_beside;    // yz, zx, xy; w: weight [N]
    vec4  diagonal;          // of its inertia: xx, yy, zz [N m]; w: the sum of m / h^2 [N/m]
    vec4  beside;            // yz, zx, xy
};
// Sums over a chunk's nodes, about the object's first node.
struct StepBodySums {    // 48 bytes
    vec4  arm;               // m / h^2 times the position [N]; w: m / h^2 [N/m]
    vec4  square;            // m / h^2 x x^T: xx, yy, zz [N m]; w: how many nodes are held
    vec4  beside;            // yz, zx, xy
};
// Of a field of forces over a chunk's nodes.
struct ResidualSums {    // 32 bytes
    vec4  force;             // [N]; w: its product with a field of displacements [J]
    vec4  moment;            // about the body's centre [N m]
};
// A rigid motion of a body [m], [rad], or the force and moment for it [N], [N m].
struct BodyMotion {      // 32 bytes
    vec4  displacement;
    vec4  rotation;          // about the centre
};
// The inverse of a body's block, [[A, B], [B^T, C]], as columns: A^-1, X = A^-1 B, and (C - B^T X)^-1.
struct BodyInverse {     // 144 bytes
    vec4  a_x;
    vec4  a_y;
    vec4  a_z;
    vec4  b_x;
    vec4  b_y;
    vec4  b_z;
    vec4  c_x;
    vec4  c_y;
    vec4  c_z;
};
// Of an island's conjugate gradients, before an iteration.
struct SolveState {      // 32 bytes
    float lack;              // r . z [J]
    uint  is_done;           // with this linearisation
    uint  is_stuck;          // no curvature was left
    uint  iterations;        // in all
    uint  made;              // with this linearisation
    float enough;            // of all bodies together, below which it is done [J]
    uint  is_over;           // with all linearisations
    uint  unused;
};
