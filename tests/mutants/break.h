#pragma once

namespace gelatin::test {

/// A way to break a shader: `from` in `file` (below shaders/) becomes `to`.
struct Break {
    const char* name;
    const char* file;
    const char* from;
    const char* to;
};

}  // namespace gelatin::test
