#include "gl/fence.h"

#include <epoxy/gl.h>

#include "gelatin/error.h"

namespace gelatin::gl {
namespace {

constexpr GLuint64 kNanosecondsPerSecond = 1'000'000'000;

// Flushes, because a fence that is still in the client's queue would never be signalled.
GLenum poll(void* sync, GLuint64 timeout) {
    return glClientWaitSync(static_cast<GLsync>(sync), GL_SYNC_FLUSH_COMMANDS_BIT, timeout);
}

}  // namespace

Fence Fence::insert() {
    Fence fence;
    fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    return fence;
}

Fence::~Fence() {
    if (sync_ != nullptr) glDeleteSync(static_cast<GLsync>(sync_));
}

bool Fence::is_passed() const {
    if (sync_ == nullptr) return true;
    const GLenum state = poll(sync_, 0);
    return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

void Fence::wait() const {
    if (sync_ == nullptr) return;
    GLenum state = GL_TIMEOUT_EXPIRED;
    while (state == GL_TIMEOUT_EXPIRED) state = poll(sync_, kNanosecondsPerSecond);
    if (state == GL_WAIT_FAILED) throw GlError("waiting for the GPU failed: the OpenGL context is lost");
}

}  // namespace gelatin::gl
