#pragma once

#include <epoxy/gl.h>

namespace gelatin::gl {

/// The value of a state variable of the current context that is one integer.
inline GLint get_integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

}  // namespace gelatin::gl
