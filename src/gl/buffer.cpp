#include "gl/buffer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

#include "gelatin/error.h"
#include "gl/debug.h"
#include "gl/hazards.h"

namespace gelatin::gl {
namespace {

// What the smallest buffers hold: a texel of the largest format, or an element of most blocks.
constexpr std::size_t kLeastBytes = 16;

struct TexelLayout {
    GLenum internal_format;
    std::size_t bytes;
};

TexelLayout layout_of(TexelFormat format) {
    switch (format) {
        case TexelFormat::r32ui:
            return {GL_R32UI, 4};
        case TexelFormat::rg32ui:
            return {GL_RG32UI, 8};
        case TexelFormat::rgb32ui:
            return {GL_RGB32UI, 12};
        case TexelFormat::rgba32ui:
            return {GL_RGBA32UI, 16};
        case TexelFormat::r32f:
            return {GL_R32F, 4};
        case TexelFormat::rg32f:
            return {GL_RG32F, 8};
        case TexelFormat::rgba32f:
            break;
    }
    return {GL_RGBA32F, 16};
}

}  // namespace

RawBuffer::RawBuffer(std::size_t bytes, const void* data, Use use) : bytes_(bytes) {
    GLint64 limit = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
    if (use == Use::storage && bytes > static_cast<std::size_t>(limit)) {
        throw GlError("a buffer of " + std::to_string(bytes) + " bytes is more than this driver's limit of " +
                      std::to_string(limit) + " bytes per storage block (GL_MAX_SHADER_STORAGE_BLOCK_SIZE)");
    }
    check_errors("before a buffer's allocation");
    GLuint id = 0;
    glGenBuffers(1, &id);
    if (hazard_probe != nullptr) hazard_probe->resets(id);
    glBindBuffer(GL_COPY_WRITE_BUFFER, id);
    // A block or texture of no bytes cannot be bound.
    const bool is_large_enough = bytes >= kLeastBytes;
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(std::max(bytes, kLeastBytes)),
                 is_large_enough ? data : nullptr, GL_DYNAMIC_COPY);
    if (!is_large_enough && bytes > 0 && data != nullptr)
        glBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
    if (glGetError() != GL_NO_ERROR) {
        glDeleteBuffers(1, &id);
        throw GlError("the driver has no memory for a buffer of " + std::to_string(bytes) + " bytes");
    }
    name_ = std::make_shared<unsigned>(id);
}

RawBuffer& RawBuffer::operator=(RawBuffer&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    RawBuffer old(std::move(other));  // frees what this one held now, not when `other` ends
    return *this;
}

RawBuffer::~RawBuffer() {
    if (id() == 0) return;
    if (hazard_probe != nullptr) hazard_probe->resets(id());
    glDeleteBuffers(1, name_.get());
    *name_ = 0;
    forget_state();
}

void RawBuffer::upload(std::size_t offset, std::size_t bytes, const void* data) {
    if (bytes == 0) return;
    if (hazard_probe != nullptr) hazard_probe->uploads(id(), bytes == bytes_);
    // Not by glBufferSubData: with NVIDIA's driver (580.159) later dispatches may not see what it wrote
    // (docs/decisions/0047-first-gpu.md).
    GLuint staging = 0;
    glGenBuffers(1, &staging);
    glBindBuffer(GL_COPY_READ_BUFFER, staging);
    glBufferData(GL_COPY_READ_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
    glBindBuffer(GL_COPY_WRITE_BUFFER, id());
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, static_cast<GLintptr>(offset),
                        static_cast<GLsizeiptr>(bytes));
    glDeleteBuffers(1, &staging);
}

void RawBuffer::copy_from(const RawBuffer& source) {
    if (bytes_ == 0) return;
    if (hazard_probe != nullptr) hazard_probe->copies(source.id(), id());
    glBindBuffer(GL_COPY_READ_BUFFER, source.id());
    glBindBuffer(GL_COPY_WRITE_BUFFER, id());
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0, static_cast<GLsizeiptr>(bytes_));
}

void RawBuffer::download(std::size_t offset, std::size_t bytes, void* out) const {
    if (bytes == 0) return;
    if (hazard_probe != nullptr) hazard_probe->downloads(id());
    glBindBuffer(GL_COPY_READ_BUFFER, id());
    glGetBufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes),
                       out);
}

void RawBuffer::fill(std::uint32_t value) {
    if (bytes_ == 0) return;
    if (hazard_probe != nullptr) hazard_probe->clears(id());
    glBindBuffer(GL_COPY_WRITE_BUFFER, id());
    glClearBufferData(GL_COPY_WRITE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

BufferTexture::BufferTexture(unsigned buffer, std::size_t bytes, TexelFormat format) {
    const TexelLayout layout = layout_of(format);
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    const std::size_t texels = bytes / layout.bytes;
    if (texels > static_cast<std::size_t>(limit)) {
        throw GlError("a buffer of " + std::to_string(texels) +
                      " texels is more than this driver's limit of " + std::to_string(limit) +
                      " (GL_MAX_TEXTURE_BUFFER_SIZE)");
    }
    GLuint id = 0;
    glGenTextures(1, &id);
    forget_state();  // the unit's binding changes
    glBindTexture(GL_TEXTURE_BUFFER, id);
    glTexBuffer(GL_TEXTURE_BUFFER, layout.internal_format, buffer);
    name_ = std::make_shared<unsigned>(id);
}

BufferTexture& BufferTexture::operator=(BufferTexture&& other) noexcept {
    std::swap(name_, other.name_);
    BufferTexture old(std::move(other));
    return *this;
}

BufferTexture::~BufferTexture() {
    if (id() == 0) return;
    glDeleteTextures(1, name_.get());
    *name_ = 0;
    forget_state();
}

}  // namespace gelatin::gl
