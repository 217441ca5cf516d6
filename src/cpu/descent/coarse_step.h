#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/descent/coarse_correction.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/secant_step.h"
#include "cpu/descent/step_objective.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Moves all nodes at once along the motions of clusters (cpu/descent/coarse_correction.h), as far as the
/// objective falls.
template <class Real>
class CoarseStep {
public:
    explicit CoarseStep(std::shared_ptr<const Model> model);

    bool is_empty() const { return coarse_.is_empty(); }  ///< there is nothing for it to move

    /// To be called before others of a step of `step` seconds.
    void begin(Real step, std::span<const Vec4<Real>> positions) { coarse_.begin(step, positions); }

    void run(const StepObjective<Real>& objective, const ColliderContacts<Real>& contacts,
             SecantStep<Real>& secant, std::vector<Vec4<Real>>& positions);

private:
    std::shared_ptr<const Model> model_;
    CoarseCorrection<Real> coarse_;
};

}  // namespace gelatin::cpu
