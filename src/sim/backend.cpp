#include "sim/backend.h"

#include <fmt/core.h>

#include <cstdlib>
#include <string_view>

#include "core/log.h"
#include "gelatin/error.h"
#include "gl/debug.h"
#include "gl/hazards.h"

namespace gelatin {

SimulatorOptions with_needed_backend(SimulatorOptions options, const Scene& scene, const Model& model) {
    if (has_contacts(model, scene.collision)) {
        // Where bodies meet, steps are made on the processor with any backend (docs/contact.md).
        if (options.backend == Backend::automatic && model.objects.size() > 1) options.backend = Backend::cpu;
        return options;
    }
    if (scene.collision.broad_phase != BroadPhase::depth) return options;
    if (scene.collision.proximity_radius) {
        throw InvalidInput({scene.file.string(),
                            0,
                            "collision.proximity_radius",
                            {},
                            "must not be given with broad_phase = \"depth\", which finds what touches, not "
                            "what is near"});
    }
    if (options.backend == Backend::cpu) {
        throw InvalidInput({scene.file.string(), 0, "collision.broad_phase", "\"depth\"",
                            "needs OpenGL; with --backend cpu it must be none, boxes or hierarchy"});
    }
    options.backend = Backend::gl;
    return options;
}

std::optional<gl::Context> make_context(const SimulatorOptions& options) {
    if (options.use_current_context) return gl::Context::current();
    if (options.backend == Backend::cpu && !options.need_gl) return std::nullopt;
    const bool needed = options.backend == Backend::gl || options.need_gl;
    try {
        gl::Context context = gl::Context::headless({options.gl_device, options.gl_debug});
        if (options.gl_debug) {
            gl::enable_debug_output();
            gl::enable_hazard_tracking();
        }
        return context;
    } catch (const NoOpenGl& problem) {
        if (needed) throw;
        log_debug(fmt::format("simulating on the CPU: {}", problem.what()));
        return std::nullopt;
    }
}

bool choose_gl(const SimulatorOptions& options, const std::optional<gl::Context>& context) {
    if (options.backend == Backend::automatic) return context && !context->device().is_software;
    return options.backend == Backend::gl;
}

bool makes_contacts_on_device() {
    const char* const where = std::getenv("GELATIN_CONTACT");
    return where != nullptr && std::string_view(where) == "device";
}

}  // namespace gelatin
