#pragma once

#include <string>
#include <vector>

#include "gl/barrier.h"

namespace gelatin::gl {

/// Where a linked program looks for buffers, and what it does with them.
struct ProgramAccess {
    struct Block {
        std::string name;
        bool reads, writes;
        unsigned index;  // of the program's storage blocks
    };
    struct Texels {
        std::string name;  // of a samplerBuffer
        int location;
    };
    std::string name;
    std::vector<Block> blocks;
    std::vector<Texels> texels;
};

/// Asks the driver for active blocks and samplers, and `source`, that of all stages with includes expanded,
/// for `readonly` and `writeonly`. A block that the source does not have may be read and written.
ProgramAccess reflect_accesses(unsigned program, const std::string& name, const std::string& source);

/// A buffer that is bound where a command uses it.
struct BoundBuffer {
    unsigned buffer;
    Barrier use;
    bool reads, writes;
    std::string through;
};

/// What is bound now to the program's blocks and samplers.
std::vector<BoundBuffer> bound_buffers(unsigned program, const ProgramAccess& access);

/// What the vertex array in use fetches vertices and, with `has_elements`, indices from.
std::vector<BoundBuffer> bound_vertex_buffers(bool has_elements);

}  // namespace gelatin::gl
