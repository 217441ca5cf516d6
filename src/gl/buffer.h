#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "gl/object_name.h"

namespace gelatin::gl {

/// The untyped owner behind Buffer<T>: one GL buffer object of a fixed size.
class RawBuffer {
public:
    RawBuffer() = default;
    /// How shaders access it: as a storage block, whose size the driver limits, or through a BufferTexture.
    enum class Use { storage, texels };

    /// @throws GlError if the driver cannot give `bytes`, or its limit of storage blocks is less than these
    /// of one.
    RawBuffer(std::size_t bytes, const void* data, Use use = Use::storage);
    RawBuffer(RawBuffer&& other) noexcept
        : name_(std::exchange(other.name_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
    RawBuffer& operator=(RawBuffer&& other) noexcept;
    ~RawBuffer();

    const ObjectName& name() const { return name_; }
    unsigned id() const { return id_of(name_); }
    std::size_t bytes() const { return bytes_; }
    void upload(std::size_t offset, std::size_t bytes, const void* data);
    void download(std::size_t offset, std::size_t bytes, void* out) const;
    void fill(std::uint32_t value);
    void copy_from(const RawBuffer& source);

private:
    ObjectName name_;
    std::size_t bytes_ = 0;
};

/// Owns one GL buffer object holding `size()` elements of `T` (a std430 array).
///
/// Move-only. A default-made or moved-from buffer is no GL object, and no program runs with it bound. A
/// buffer without elements is a GL object that may be bound to programs as long as they do not read it. Every
/// call needs the context that created the buffer to be current on the calling thread.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    Buffer() = default;

    /// Allocates `size` elements with undefined contents.
    /// @throws GlError if the driver cannot give `size * sizeof(T)` bytes, or its block limit is smaller.
    explicit Buffer(std::size_t size) : raw_(size * sizeof(T), nullptr), size_(size) {}

    /// Allocates and fills.
    explicit Buffer(std::span<const T> data) : raw_(data.size_bytes(), data.data()), size_(data.size()) {}

    Buffer(Buffer&& other) noexcept : raw_(std::move(other.raw_)), size_(std::exchange(other.size_, 0)) {}
    Buffer& operator=(Buffer&& other) noexcept {
        raw_ = std::move(other.raw_);
        size_ = std::exchange(other.size_, 0);
        return *this;
    }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const ObjectName& name() const { return raw_.name(); }
    unsigned id() const { return raw_.id(); }

    /// To the elements from `first` on. @pre first + data.size() <= size()
    void upload(std::span<const T> data, std::size_t first = 0) {
        raw_.upload(first * sizeof(T), data.size_bytes(), data.data());
    }

    /// Copies the contents to `out`; blocks until the GPU has finished.
    /// @pre out.size() == size(), and barrier(buffer_update) since the last dispatch
    void download(std::span<T> out) const { raw_.download(0, out.size_bytes(), out.data()); }

    /// Copies all elements on the device. @pre source.size() == size(), and barrier(buffer_update) since the
    /// last dispatch
    void copy_from(const Buffer& source) { raw_.copy_from(source.raw_); }

    /// Sets every element, without a copy from the host. @pre barrier(buffer_update) since the last dispatch
    void fill(std::uint32_t value) requires std::is_same_v<T, std::uint32_t> { raw_.fill(value); }

private:
    RawBuffer raw_;
    std::size_t size_ = 0;
};

/// How a shader's samplerBuffer interprets a buffer's bytes.
enum class TexelFormat { r32ui, rg32ui, rgb32ui, rgba32ui, r32f, rg32f, rgba32f };

/// A buffer read through a samplerBuffer or usamplerBuffer. Gathers through it are faster than storage reads
/// on software drivers and no slower elsewhere. Owns the texture, not the buffer, which must outlive it.
class BufferTexture {
public:
    BufferTexture() = default;
    /// @throws GlError if the buffer has more texels than GL_MAX_TEXTURE_BUFFER_SIZE.
    template <class T>
    BufferTexture(const Buffer<T>& buffer, TexelFormat format)
        : BufferTexture(buffer.id(), buffer.size() * sizeof(T), format) {}
    BufferTexture(unsigned buffer, std::size_t bytes, TexelFormat format);
    BufferTexture(BufferTexture&& other) noexcept = default;
    BufferTexture& operator=(BufferTexture&& other) noexcept;
    ~BufferTexture();

    const ObjectName& name() const { return name_; }
    unsigned id() const { return id_of(name_); }

private:
    ObjectName name_;
};

/// A read-only table that shaders read through a samplerBuffer: a buffer and its texture in one. It may be
/// larger than a storage block.
///
/// Move-only; one that was default-made or moved from is no GL object.
template <class T>
class TexelTable {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    TexelTable() = default;

    /// A table without values contains one T{}, because textures are never empty.
    /// @throws GlError if the driver cannot give the bytes, or has textures of fewer texels.
    TexelTable(std::span<const T> values, TexelFormat format)
        : TexelTable(values.empty() ? &kNothing : values.data(), std::max<std::size_t>(values.size(), 1),
                     format) {}

    /// True if it was default-made or moved from.
    bool is_empty() const { return texels_.id() == 0; }
    const BufferTexture& texels() const { return texels_; }

private:
    static constexpr T kNothing{};

    TexelTable(const T* values, std::size_t size, TexelFormat format)
        : raw_(size * sizeof(T), values, RawBuffer::Use::texels), texels_(raw_.id(), raw_.bytes(), format) {}

    RawBuffer raw_;
    BufferTexture texels_;
};

}  // namespace gelatin::gl
