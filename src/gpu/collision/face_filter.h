#pragma once

#include <string>

#include "gl/program.h"
#include "gpu/collision/collision_buffers.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// Finds the faces and objects that may touch any other object, before pairs of objects are sought. All
/// others are left out of the search.
class FaceFilter {
public:
    virtual ~FaceFilter() = default;

    /// Ends with the barriers that the search for pairs needs. @pre the boxes are those of `nodes`
    virtual void run(const ModelBuffers& model, const CollisionBuffers& collision,
                     const NodeBuffers& nodes) = 0;

    /// The shader FILE of sim/collision/, with the filter's face_may_collide and object_may_collide in place
    /// of those of sim/collision/may_collide.glsl.
    virtual gl::Program compile(const std::string& file) const = 0;
    /// Binds what these two read to a program that it has compiled.
    virtual void bind(const gl::Program& program) const = 0;
};

/// The shader FILE of sim/collision/, with what `filter` left out, if there is one.
inline gl::Program compile_filtered(const FaceFilter* filter, const std::string& file,
                                    const gl::Defines& defines = {}) {
    return filter != nullptr ? filter->compile(file) : gl::Program::compute("sim/collision/" + file, defines);
}

}  // namespace gelatin::gpu
