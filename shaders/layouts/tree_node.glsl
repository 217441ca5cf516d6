// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
struct TreeNode {        // 16 bytes
    uint  skip;          // the node behind all that is below this one
    uint  first_item;    // of a leaf
    uint  item_count;    // 1 .. 4 of a leaf, 0 of others
    uint  root_of;       // number of the tree whose root it is; 0xFFFFFFFF: none's
};
