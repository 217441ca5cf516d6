#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "gelatin/scene.h"
#include "model/model.h"
#include "model/solver.h"
#include "sim/energy_budget.h"
#include "sim/run_clock.h"

namespace gelatin {

/// Checks a run against what physics allows, step by step and frame by frame, and reports violations.
class Watch {
public:
    /// @param scene must outlive the watch
    Watch(const Scene& scene, std::shared_ptr<const Model> model, int substeps);

    /// Starts the energy balance here.
    void begin(const State& state, const Moment& moment);

    /// A user pulls or drags something until this time [s]: the work is unknown.
    void note_hand(double until) { handled_until_ = until; }

    /// The largest kinetic energy that Solver::watch_nodes may find in a node at this time [J].
    double most_energy(double time) const { return somebody_acts(time) ? kAnyEnergy : budget_.most_at(time); }

    /// @throws Diverged if the alarm belongs to the steps until `until`, naming the step, the node and the
    ///   likely cause.
    /// @param now not before the alarm; it supplies the upper half of the step number
    void check(const Alarm& alarm, const Moment& until, const Moment& now) const;

    /// @throws Diverged unless start, gravity and loads explain the bodies' energy. After handles have moved,
    ///   the present energy is accepted and the balance starts from there.
    void check(const std::vector<ObjectMeasure>& objects, const Moment& moment);

private:
    static constexpr double kAnyEnergy = 1e38;  // [J], which a float holds

    [[noreturn]] void fail(const Alarm& alarm, std::uint64_t step, const Moment& now) const;

    // Their work since the last account is unknown.
    bool somebody_acts(double until) const {
        return budget_.time() < handled_until_ ||
               any_acts(model_->handles, budget_.time(), until, step_size());
    }
    double step_size() const { return scene_.simulation.frame_time() / substeps_; }  // [s]

    const Scene& scene_;
    std::shared_ptr<const Model> model_;
    int substeps_;
    double handled_until_ = -std::numeric_limits<double>::infinity();  // [s]
    EnergyBudget budget_;
};

}  // namespace gelatin
