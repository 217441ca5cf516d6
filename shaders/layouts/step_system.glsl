// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A body of which no node is held, as a rigid one in the system of a step: its nodes have the inertia m / h^2 [N/m] there.
struct StepBody {        // 48 bytes
    vec4  center;            // xyz [m]; w: 1 over the sum of m / h^2 [m/N], 0 if a node is held
    vec4  inverse_diagonal;  // of its inertia about the centre, inverted: xx, yy, zz [1/(N m)]; w: energy that may be missing [J]
    vec4  inverse_beside;    // yz, zx, xy
};
// Sums over a chunk's nodes, about the object's first node.
struct StepBodySums {    // 48 bytes
    vec4  arm;               // m / h^2 times the position [N]; w: m / h^2 [N/m]
    vec4  square;            // m / h^2 x x^T: xx, yy, zz [N m]; w: how many nodes are held
    vec4  beside;            // yz, zx, xy
};
struct ResidualSums {    // 32 bytes
    vec4  force;             // of the residual r [N]; w: r . z, with z by the nodes' own blocks [J]
    vec4  moment;            // about the body's centre [N m]
};
// Of a body's conjugate gradients, before an iteration.
struct SolveState {      // 16 bytes
    float lack;              // r . z [J]
    uint  is_done;
    uint  is_stuck;          // no curvature was left
    uint  iterations;
};
