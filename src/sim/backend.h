#pragma once

#include <memory>
#include <optional>

#include "gelatin/simulator.h"
#include "gl/context.h"
#include "model/solver.h"

namespace gelatin {

/// The options with the backend that the scene needs in place of `automatic`, if it needs one.
/// @throws InvalidInput if another one is asked for.
SimulatorOptions with_needed_backend(SimulatorOptions options, const Scene& scene);

/// The context that the options ask for: the host's, a headless one, or none where nothing needs GL.
/// @throws NoOpenGl if GL is needed and there is none.
std::optional<gl::Context> make_context(const SimulatorOptions& options);

/// Whether the GL backend simulates: as asked, or where `automatic` finds a GPU that is not a software
/// driver.
bool choose_gl(const SimulatorOptions& options, const std::optional<gl::Context>& context);

}  // namespace gelatin
