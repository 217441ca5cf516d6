#pragma once

#include <map>
#include <string>

namespace gelatin::gl {

/// What a shader may do with a storage block.
struct BlockAccess {
    bool reads = true;
    bool writes = true;
};

/// The storage blocks of a shader's expanded source, by name, as their `readonly` and `writeonly` say, which
/// OpenGL's own reflection does not report. Follows #ifdef, #ifndef and #if with `defined(NAME)` alone; of
/// other conditions both branches count. A block declared more than once may do what any declaration allows.
std::map<std::string, BlockAccess> block_accesses(const std::string& source);

}  // namespace gelatin::gl
