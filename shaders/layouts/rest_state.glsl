// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Whether all bodies rest.
struct RestState {       // 16 bytes
    float time;          // for which all nodes have kept to their places [s]
    uint  is_restless;   // 1: a node has left its place, or something drives bodies
    uint  takes_places;  // 1: nodes get new places where the next step begins
    uint  rests;         // 1: nothing moves in this step
};
