#pragma once

#include <memory>
#include <optional>

#include "gelatin/simulator.h"
#include "gl/context.h"
#include "model/solver.h"

namespace gelatin {

/// The options, with the backend that the scene requires instead of `automatic`.
/// @throws InvalidInput if the options name another one.
SimulatorOptions with_needed_backend(SimulatorOptions options, const Scene& scene, const Model& model);

/// The context for the options: the host's, a headless one, or none if nothing needs GL.
/// @throws NoOpenGl if GL is needed and there is none.
std::optional<gl::Context> make_context(const SimulatorOptions& options);

/// Whether the GL backend simulates: as requested, or for `automatic` on a GPU that is not a software driver.
bool choose_gl(const SimulatorOptions& options, const std::optional<gl::Context>& context);

/// Whether steps with contacts between bodies are made on the device where the backend is OpenGL: by the
/// environment variable GELATIN_CONTACT (docs/command-line.md). Else SharedSolver makes them.
bool makes_contacts_on_device();

}  // namespace gelatin
