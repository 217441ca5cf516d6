#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/drive/pulls.h"
#include "cpu/implicit/contact_rows.h"
#include "cpu/implicit/energy_account.h"
#include "cpu/implicit/find_pairs.h"
#include "cpu/implicit/guard.h"
#include "cpu/implicit/islands.h"
#include "cpu/implicit/paces.h"
#include "cpu/implicit/restitution.h"
#include "cpu/implicit/step_system.h"
#include "cpu/implicit/time_scheme.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::test {

/// Parts of implicit steps in double precision from the classes that cpu::ImplicitStep is made of; with all
/// that passes between these open to see and to change.
class EndReference {
public:
    using Field = std::vector<glm::dvec3>;
    enum class Outcome { made, damped, divided, stood_still };

    /// @param contacts whether objects meet each other, and bodies themselves
    EndReference(std::shared_ptr<const Model> model, double restitution, bool contacts);

    void begin();
    /// A part of `step` seconds is tried: solves it. @param damps by Euler's scheme
    void solve(double step, bool damps);
    /// With the displacements there are. @param shortest that a part may be [s]
    Outcome end(double shortest);

    std::shared_ptr<const Model> model;
    std::shared_ptr<const ContactSurface> surface;
    cpu::Nodes<double> from, to;
    std::vector<glm::dvec4> loads;                  ///< [N], or none
    std::vector<cpu::ContactRow<double>> own_rows;  ///< that are among those of each part
    const cpu::Pulls<double>* pulls = nullptr;
    cpu::StepSystem<double> system;
    cpu::ContactRows<double> rows;
    cpu::TimeScheme<double> scheme;
    cpu::EnergyAccount<double> energy;
    cpu::Paces<double> paces;
    cpu::Restitution<double> restitution;
    cpu::Guard<double> guard;
    cpu::Islands islands;
    double step_size = 0.0, gained = 0.0;
    bool has_past = false, is_guarded = false, has_bounced = false;
    bool is_apart = false;            ///< no object touches another in the next solve
    std::vector<glm::dvec4> guarded;  ///< where the guard has moved nodes; w: -1 where it has not

private:
    glm::dvec3 acceleration(std::size_t n) const;
    void find_rows();
    void linearise();
    void finish();
    double measure();
    void run_guard();
    std::vector<std::uint32_t> stop_guarded();

    bool contacts_;
    cpu::FindPairs<double> pairs_;
    std::vector<std::uint32_t> object_of_;
    std::vector<std::uint8_t> asleep_;  // none
    Field expected_, on_held_;
    std::vector<glm::dvec4> ends_;
    std::vector<double> compliances_;
};

}  // namespace gelatin::test
