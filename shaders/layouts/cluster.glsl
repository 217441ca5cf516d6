// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A cluster of the coarse basis at rest, and as it is in a step.
struct ClusterRest {     // 32 bytes
    vec4  middle;        // of its core [m]
    uint  object;
    uint  core_first;    // nodes of its core
    uint  core_end;
    uint  row;           // of the inverse of its object's matrix: 6 times its place in the object
};
struct Cluster {         // 96 bytes
    vec4  middle;        // of its core [m]
    vec4  orientation_x; // columns
    vec4  orientation_y;
    vec4  orientation_z;
    vec4  translation;   // [m]
    vec4  rotation;      // [radians]
};
// The clusters of an object, and its matrix.
struct CoarseBody {      // 16 bytes
    uint  first;
    uint  count;
    uint  matrix;        // its first element in the array of all
    float body_length;   // at rest [m]
};
