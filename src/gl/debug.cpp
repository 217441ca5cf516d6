#include "gl/debug.h"

#include <epoxy/gl.h>

#include <mutex>
#include <utility>

#include "core/log.h"
#include "gelatin/error.h"

namespace gelatin::gl {
namespace {

// A driver may repeat itself every frame; more messages than this give no new information.
constexpr std::size_t kMaxMessages = 1000;

std::mutex messages_mutex;
std::vector<std::string> messages;

const char* type_name(GLenum type) {
    switch (type) {
        case GL_DEBUG_TYPE_ERROR:
            return "error";
        case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR:
            return "undefined behaviour";
        case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR:
            return "deprecated";
        case GL_DEBUG_TYPE_PORTABILITY:
            return "portability";
        default:
            return nullptr;
    }
}

void APIENTRY receive(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                      const void*) {
    const char* name = type_name(type);
    if (name == nullptr || severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    std::string message = std::string("OpenGL ") + name + ": ";
    message.append(text,
                   length < 0 ? std::char_traits<char>::length(text) : static_cast<std::size_t>(length));
    while (!message.empty() && message.back() == '\n') message.pop_back();
    const std::lock_guard lock(messages_mutex);
    if (messages.size() >= kMaxMessages) return;
    log_warning(message);
    messages.push_back(std::move(message));
}

const char* error_name(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE:
            return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION:
            return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY:
            return "GL_OUT_OF_MEMORY";
        default:
            return "an unknown OpenGL error";
    }
}

}  // namespace

void enable_debug_output() {
    glEnable(GL_DEBUG_OUTPUT);
    // Synchronous, so that a debugger's stack shows the call that caused the message.
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(receive, nullptr);
}

std::vector<std::string> take_debug_messages() {
    const std::lock_guard lock(messages_mutex);
    return std::exchange(messages, {});
}

void check_errors(const char* what) {
    const GLenum first = glGetError();
    if (first == GL_NO_ERROR) return;
    // Several flags may be set; a lost context would report forever.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) continue;
    throw GlError(std::string(what) + ": " + error_name(first));
}

}  // namespace gelatin::gl
