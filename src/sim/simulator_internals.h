#pragma once

#include <memory>
#include <span>

#include "gelatin/simulator.h"
#include "gl/host_state.h"
#include "model/model.h"
#include "model/solver.h"
#include "sim/recording/recorded_frame.h"

namespace gelatin {

/// What this repository's own programs and tests need of a simulator beyond its public interface.
struct SimulatorInternals {
    using Impl = Simulator::Impl;

    static const Model& model(const Simulator& simulator);

    /// In the order of Scene::attachments; of a recording, those that are drawn.
    static std::span<const Attachment> attachments(const Simulator& simulator);

    /// The model and the solver that it has at present: others after set_material or pin.
    static std::shared_ptr<const Model> share_model(const Simulator& simulator);
    static std::shared_ptr<const Solver> share_solver(const Simulator& simulator);

    /// Makes its OpenGL context, if it has one, current on the calling thread.
    static void make_current(Simulator& simulator);
    /// Makes a context to draw in, if it has none, and that current. @throws NoOpenGl
    static void need_context(Simulator& simulator);

    /// Keeps the state of OpenGL of the application in whose context the simulator works, while the result
    /// lives; null if the context is its own.
    static std::unique_ptr<gl::HostState> keep_host_state(const Simulator& simulator);

    /// A simulator with tets and springs that were made before.
    /// @param model what build_model made of this very scene
    static Simulator make(const Scene& scene, std::shared_ptr<const Model> model,
                          const SimulatorOptions& options);

    /// The same that plays a recording. @param model what build_model made of its scene
    static Simulator make(std::shared_ptr<const Recording> recording, std::shared_ptr<const Model> model,
                          const SimulatorOptions& options);

    /// Without what programs have attached.
    static Scene own_scene(const Simulator& simulator);

    /// The present frame, for a recording.
    static RecordedFrame recorded_frame(const Simulator& simulator);

    /// Another simulator of the same scene and model, at the start. It repeats no check and no message.
    /// @pre `like` has no OpenGL context
    static Simulator another(const Simulator& like);
};

inline const Model& model_of(const Simulator& simulator) {
    return SimulatorInternals::model(simulator);
}

}  // namespace gelatin
