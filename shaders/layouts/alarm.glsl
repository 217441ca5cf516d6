// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// The first step after which nodes were not as physics allows, as watch_nodes notes it.
struct Alarm {     // 16 bytes
    uint step;     // its number; 0xFFFFFFFF before there is one
    uint node;     // the least of these nodes
    uint count;    // of them, 0 before there is one
    uint speed;    // of the fastest [m/s], the bits of a float; above those of infinity where one is not finite
};
