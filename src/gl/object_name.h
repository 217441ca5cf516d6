#pragma once

#include <memory>

namespace gelatin::gl {

/// The name of a GL object as its owner and the programs that it is bound to share it: the owner sets it to 0
/// when it deletes the object, so that no program goes on using a name that may be another object's by then.
/// Null and 0 both mean: no object.
using ObjectName = std::shared_ptr<unsigned>;

inline unsigned id_of(const ObjectName& name) {
    return name == nullptr ? 0 : *name;
}

/// Makes the next dispatch or draw use its program and bind its resources again, whatever this thread's last
/// one was. Called wherever code that is not this layer's may have used OpenGL: at the library's entries.
void forget_state();

}  // namespace gelatin::gl
