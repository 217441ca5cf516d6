#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "cpu/implicit/islands.h"
#include "cpu/implicit/step_system.h"
#include "cpu/implicit/time_scheme.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// How bodies move beside what they touch: by it steps are divided, and schemes of time are chosen.
///
/// Schemes that hardly damp let bodies that rest tremble on for ever. So islands that are calm go on by
/// implicit Euler's, and those that are still with dampers, too.
template <class Real>
class Paces {
public:
    explicit Paces(std::shared_ptr<const Model> model);

    /// All count as moving.
    void forget();
    void archive(Archive& archive);

    /// A body whose velocities do not go on from those before is struck: it makes its next step by Euler's
    /// scheme. @return by body, whether it is
    std::vector<std::uint8_t>& struck() { return is_struck_; }

    /// Hardly vibrates, and touches others but hardly goes towards or away from them.
    bool is_calm(std::size_t body) const { return paces_[body] != Pace::moving; }

    /// Into how many parts a step is divided at least: into four where bodies that touch others move, or
    /// rigid ones are attached, two where all are calm, one where all are still or nothing is near.
    std::uint32_t count_parts(std::span<const ContactRow<Real>> rows) const;

    /// The scheme of each body, by island, and the dampers of contacts.
    /// @param step of the part [s] @param damps whether all go by Euler's
    /// @return whether any goes on by another
    bool choose(const Islands& islands, Real step, bool damps, std::span<ContactRow<Real>> rows,
                TimeScheme<Real>& scheme) const;

    /// By how a step has ended. @param asleep bodies
    void find(const StepSystem<Real>& system, std::span<const std::uint8_t> asleep,
              const Nodes<Real>& current);

private:
    // Still ones are calm, and hardly move at all.
    enum class Pace : std::uint8_t { moving, calm, still };

    bool ties_rigid_body(const ContactRow<Real>& row) const;

    std::shared_ptr<const Model> model_;
    std::vector<Pace> paces_;  // of bodies
    std::vector<std::uint8_t> is_struck_;
};

}  // namespace gelatin::cpu
