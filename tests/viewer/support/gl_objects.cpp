#include "viewer/support/gl_objects.h"

#include <epoxy/gl.h>

namespace gelatin::test {
namespace {

constexpr GLuint kMostNames = 4000;  // drivers give the least that is free

int fences = 0;
PFNGLFENCESYNCPROC make_fence = nullptr;
PFNGLDELETESYNCPROC delete_fence = nullptr;

GLsync EPOXY_CALLSPEC counted_fence(GLenum condition, GLbitfield flags) {
    ++fences;
    return make_fence(condition, flags);
}

void EPOXY_CALLSPEC counted_delete(GLsync fence) {
    if (fence != nullptr) --fences;
    delete_fence(fence);
}

// Epoxy calls OpenGL through pointers that anybody may set, once the first call has found the driver's own.
void count_fences_from_now_on() {
    if (make_fence != nullptr) return;
    glDeleteSync(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    make_fence = epoxy_glFenceSync;
    delete_fence = epoxy_glDeleteSync;
    epoxy_glFenceSync = counted_fence;
    epoxy_glDeleteSync = counted_delete;
}

// One that is deleted while it is in use lives on until another is.
bool is_program(GLuint name) {
    if (glIsProgram(name) == GL_FALSE) return false;
    GLint is_deleted = GL_FALSE;
    glGetProgramiv(name, GL_DELETE_STATUS, &is_deleted);
    return is_deleted == GL_FALSE;
}

}  // namespace

std::map<std::string, int> count_gl_objects() {
    count_fences_from_now_on();
    std::map<std::string, int> counts{{"fences", fences}};
    for (GLuint name = 1; name < kMostNames; ++name) {
        counts["buffers"] += glIsBuffer(name);
        counts["textures"] += glIsTexture(name);
        counts["samplers"] += glIsSampler(name);
        counts["programs"] += is_program(name) ? 1 : 0;
        counts["shaders"] += glIsShader(name);
        counts["framebuffers"] += glIsFramebuffer(name);
        counts["renderbuffers"] += glIsRenderbuffer(name);
        counts["vertex arrays"] += glIsVertexArray(name);
        counts["queries"] += glIsQuery(name);
    }
    return counts;
}

}  // namespace gelatin::test
