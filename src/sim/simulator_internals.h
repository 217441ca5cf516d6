#pragma once

#include <memory>

#include "gelatin/simulator.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// What this repository's own programs and tests need of a simulator beyond its public interface.
struct SimulatorInternals {
    static const Model& model(const Simulator& simulator);
    static const Solver& solver(const Simulator& simulator);

    /// Makes its OpenGL context, if it has one, current on the calling thread.
    static void make_current(Simulator& simulator);

    /// A simulator with tets and springs that were made before.
    /// @param model what build_model made of this very scene
    static Simulator make(const Scene& scene, std::shared_ptr<const Model> model,
                          const SimulatorOptions& options);

    /// Another simulator of the same scene and model, at the start. It repeats no check and no message.
    /// @pre `like` has no OpenGL context
    static Simulator another(const Simulator& like);
};

inline const Model& model_of(const Simulator& simulator) {
    return SimulatorInternals::model(simulator);
}

}  // namespace gelatin
