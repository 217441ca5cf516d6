// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A node that a handle holds.
struct HandleNode {      // 32 bytes
    vec4  arm;           // from the handle's pivot at the start [m]; w: inverse mass once released [1/kg]
    uint  node;
    uint  handle;
    uint  animated;      // of animated handles: its place among all nodes of these; otherwise kNone
    uint  unused;
};
// How a node of an animated handle moves over one step.
struct NodeMotion {      // 32 bytes
    vec4  start;         // [m]
    vec4  velocity;      // mean over the step [m/s]
};
// A handle over one step: its nodes start at center + map arm, with the velocity velocity + rate arm.
struct HandleMotion {    // 128 bytes
    vec4  center;        // [m]; w: 1 while the nodes are held, 0 once they are released
    vec4  map_x;         // columns of the turn and scale
    vec4  map_y;
    vec4  map_z;
    vec4  velocity;      // of the pivot, mean over the step [m/s]
    vec4  rate_x;        // columns of the map's change [1/s]
    vec4  rate_y;
    vec4  rate_z;
};
