#include "gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "gelatin/error.h"
#include "gl/debug.h"
#include "gl/object_name.h"

namespace gelatin::gl {
namespace {

constexpr const char* kWhatToInstall =
    "install a driver with OpenGL 4.3 or newer (Debian: libegl1 and libgl1-mesa-dri, or the GPU vendor's "
    "own)";

bool has_extension(const char* list, const char* name) {
    return list != nullptr && epoxy_extension_in_string(list, name);
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

bool names_software(std::string renderer) {
    std::transform(renderer.begin(), renderer.end(), renderer.begin(),
                   [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
    constexpr std::array<std::string_view, 5> kNames = {"llvmpipe", "softpipe", "swrast", "software",
                                                        "swiftshader"};
    return std::any_of(kNames.begin(), kNames.end(),
                       [&](std::string_view name) { return renderer.find(name) != std::string::npos; });
}

DeviceInfo describe_device() {
    DeviceInfo info;
    info.vendor = gl_string(GL_VENDOR);
    info.renderer = gl_string(GL_RENDERER);
    info.version = gl_string(GL_VERSION);
    info.is_software = names_software(info.renderer);
    GLint64 block_bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block_bytes);
    info.max_storage_block_bytes = static_cast<std::size_t>(block_bytes);
    GLint texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    info.max_texture_buffer_texels = static_cast<std::size_t>(texels);
    GLint groups = 0;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &groups);
    info.max_work_groups_x = static_cast<unsigned>(groups);
    return info;
}

// Asks GLX only where the host application has loaded it, so that Gelatin needs no X11 libraries.
bool has_glx_context() {
    for (const char* library : {"libGLX.so.0", "libGL.so.1"}) {
        void* handle = ::dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
        if (handle == nullptr) continue;
        using GetCurrent = void* (*)();
        const auto get_current = reinterpret_cast<GetCurrent>(::dlsym(handle, "glXGetCurrentContext"));
        const bool found = get_current != nullptr && get_current() != nullptr;
        ::dlclose(handle);
        if (found) return true;
    }
    return false;
}

std::vector<EGLDeviceEXT> list_devices() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const bool can_list = has_extension(extensions, "EGL_EXT_device_enumeration") ||
                          has_extension(extensions, "EGL_EXT_device_base");
    if (!can_list || !has_extension(extensions, "EGL_EXT_platform_device")) return {};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(0, nullptr, &count) || count <= 0) return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (!eglQueryDevicesEXT(count, devices.data(), &count)) return {};
    devices.resize(static_cast<std::size_t>(count));
    return devices;
}

EGLDisplay surfaceless_display() {
    if (!has_extension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless")) {
        return EGL_NO_DISPLAY;
    }
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

EGLDisplay device_display(EGLDeviceEXT device) {
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
}

std::optional<int> device_index_from_environment() {
    const char* text = std::getenv("GELATIN_EGL_DEVICE");
    if (text == nullptr || *text == '\0') return {};
    const std::string_view value = text;
    int index = -1;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), index);
    if (error != std::errc() || end != value.data() + value.size() || index < 0) {
        throw InvalidInput(
            {{}, 0, "GELATIN_EGL_DEVICE", text, "must be the index of an EGL device: 0, 1, ..."});
    }
    return index;
}

}  // namespace

// The display stays initialised until the process ends: EGL hands out one display for one platform and
// device, and eglTerminate would end it for other contexts of ours and of the host application too.
struct Context::Handle {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    EGLSurface surface = EGL_NO_SURFACE;  // a 1x1 pbuffer where the driver needs one

    Handle() = default;
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle();

    bool make_current() const { return eglMakeCurrent(display, surface, surface, context); }
    bool create(EGLDisplay from, bool debug);
};

Context::Handle::~Handle() {
    if (context != EGL_NO_CONTEXT) {
        if (eglGetCurrentContext() == context) {
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        eglDestroyContext(display, context);
    }
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
}

// False if this display has no OpenGL 4.3; what was made until then goes with the handle.
bool Context::Handle::create(EGLDisplay from, bool debug) {
    if (from == EGL_NO_DISPLAY || !eglInitialize(from, nullptr, nullptr)) return false;
    display = from;
    if (!eglBindAPI(EGL_OPENGL_API)) return false;

    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    const bool surfaceless = has_extension(extensions, "EGL_KHR_surfaceless_context");
    const EGLint config_wishes[] = {EGL_SURFACE_TYPE, surfaceless ? 0 : EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                    EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint config_count = 0;
    const bool found = eglChooseConfig(display, config_wishes, &config, 1, &config_count) && config_count > 0;
    if (!found) {
        if (!surfaceless || !has_extension(extensions, "EGL_KHR_no_config_context")) return false;
        config = EGL_NO_CONFIG_KHR;
    }

    const EGLint wishes[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             3,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_CONTEXT_OPENGL_DEBUG,
                             debug ? EGL_TRUE : EGL_FALSE,
                             EGL_NONE};
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, wishes);
    if (context == EGL_NO_CONTEXT) return false;
    if (!surfaceless) {
        const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface = eglCreatePbufferSurface(display, config, size);
        if (surface == EGL_NO_SURFACE) return false;
    }
    return make_current() && epoxy_gl_version() >= 43;
}

Context::Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

Context Context::headless(const ContextOptions& options) {
    const std::optional<int> index =
        options.device_index ? options.device_index : device_index_from_environment();
    if (!epoxy_has_egl()) throw NoOpenGl(std::string("there is no EGL library: ") + kWhatToInstall);

    const std::vector<EGLDeviceEXT> devices = list_devices();
    const auto open = [&](EGLDisplay display) -> std::optional<Context> {
        Context context;
        context.handle_ = std::make_unique<Handle>();
        if (!context.handle_->create(display, options.debug)) return {};
        context.device_ = describe_device();
        return context;
    };

    std::optional<Context> best;
    if (index) {
        if (*index < 0 || static_cast<std::size_t>(*index) >= devices.size()) {
            throw NoOpenGl("there is no EGL device " + std::to_string(*index) + ": this machine has " +
                           std::to_string(devices.size()) + ", numbered from 0");
        }
        best = open(device_display(devices[static_cast<std::size_t>(*index)]));
        if (!best) {
            throw NoOpenGl("EGL device " + std::to_string(*index) + " has no OpenGL 4.3: " + kWhatToInstall);
        }
    } else {
        // The default display may be a software driver beside a GPU: a GPU that works is preferred.
        best = open(surfaceless_display());
        for (EGLDeviceEXT device : devices) {
            if (best && !best->device_.is_software) break;
            if (best &&
                has_extension(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) {
                continue;
            }
            std::optional<Context> candidate = open(device_display(device));
            if (candidate && (!best || !candidate->device_.is_software)) best = std::move(candidate);
        }
        if (!best) throw NoOpenGl(std::string("EGL offers no OpenGL 4.3 core context: ") + kWhatToInstall);
    }
    best->make_current();
    if (options.debug) enable_debug_output();
    return std::move(*best);
}

int Context::device_count() {
    return epoxy_has_egl() ? static_cast<int>(list_devices().size()) : 0;
}

Context Context::current() {
    forget_state();
    const bool has_context =
        (epoxy_has_egl() && eglGetCurrentContext() != EGL_NO_CONTEXT) || has_glx_context();
    if (!has_context) throw NoOpenGl("no OpenGL context is current on this thread");
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < 43) {
        throw NoOpenGl("the current context is " + gl_string(GL_VERSION) + "; OpenGL 4.3 or newer is needed");
    }
    Context context;
    context.device_ = describe_device();
    return context;
}

void Context::make_current() {
    forget_state();  // the last one of this thread may have been in another context
    if (handle_ && !handle_->make_current()) {
        throw GlError("the OpenGL context cannot be made current on this thread: is it current on another?");
    }
}

}  // namespace gelatin::gl
