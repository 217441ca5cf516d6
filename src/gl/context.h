#pragma once

#include <memory>
#include <optional>
#include <string>

namespace gelatin::gl {

/// The driver's description of itself when the context was created.
struct DeviceInfo {
    std::string vendor, renderer, version;
    bool is_software = false;  ///< llvmpipe, softpipe, swrast and the like
    std::size_t max_storage_block_bytes = 0;
    std::size_t max_texture_buffer_texels = 0;
    unsigned max_work_groups_x = 0;
};

struct ContextOptions {
    std::optional<int> device_index;  ///< EGL device to use; empty: GELATIN_EGL_DEVICE, otherwise see below
    bool debug = false;               ///< a debug context whose messages go to gl::debug (debug.h)
};

/// An OpenGL 4.3 core context without a window, made current on the calling thread by the constructor
/// (through EGL), or a view of the context that the host application has made current.
///
/// Move-only; the destructor releases what it created and does not change a host's context.
class Context {
public:
    /// Creates a headless context: on the requested device, otherwise on the surfaceless default, otherwise
    /// on the first EGL device that works. If the default is a software driver, a device that is not has
    /// priority.
    /// @throws NoOpenGl if there is no EGL, no such device, or no OpenGL 4.3; InvalidInput for a
    ///   GELATIN_EGL_DEVICE that is no index.
    static Context headless(const ContextOptions& options = {});

    /// Uses the context that is current on the calling thread.
    /// @throws NoOpenGl if there is none or it is older than 4.3.
    static Context current();

    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    ~Context();

    /// The number of EGL devices that ContextOptions::device_index may name; 0 if EGL cannot list them.
    static int device_count();

    const DeviceInfo& device() const { return device_; }
    void make_current();

private:
    struct Handle;  // the EGL objects; null for a host's context
    Context();
    std::unique_ptr<Handle> handle_;
    DeviceInfo device_;
};

}  // namespace gelatin::gl
