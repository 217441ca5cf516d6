#pragma once

#include <memory>

namespace gelatin::gl {

/// The name of a GL object, shared by its owner and the programs to which it is bound. The owner sets it to 0
/// when it deletes the object, so that no program uses a name that may belong to another object by then. Null
/// and 0 both mean: no object.
using ObjectName = std::shared_ptr<unsigned>;

inline unsigned id_of(const ObjectName& name) {
    return name == nullptr ? 0 : *name;
}

/// Makes the next dispatch or draw set its program and bind its resources again, whatever ran last on this
/// thread. Call it wherever code outside this layer may have used OpenGL: at the library's entries.
void forget_state();

}  // namespace gelatin::gl
