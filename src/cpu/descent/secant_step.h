#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/step_objective.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Of forces along displacements, before and after these [J].
struct Work {
    double here = 0.0, ahead = 0.0;
};

/// Moves objects along displacements of their nodes, each by the part of them at which the work of the
/// forces along them is zero: by the secant through its values before and after them. For an objective that
/// is quadratic there it is least so.
template <class Real>
class SecantStep {
public:
    explicit SecantStep(std::shared_ptr<const Model> model);

    /// The displacements to be tried [m], shape [nodes].
    std::vector<Vec3<Real>> displacements;

    /// The force by each node before them [N].
    const std::vector<Vec3<Real>>& find_forces(const StepObjective<Real>& objective,
                                               const ColliderContacts<Real>& colliders,
                                               const std::vector<Vec4<Real>>& positions);
    /// Finds the forces after them. @pre find_forces was called
    void look_ahead(const StepObjective<Real>& objective, const ColliderContacts<Real>& colliders,
                    const std::vector<Vec4<Real>>& positions);
    /// The work of the forces by an object's displacements. @pre forces were wanted of all its nodes that are
    /// displaced
    Work work(std::size_t object) const;
    /// The part at which the work is zero, in [0, most]; 0 where forces do not pull along the displacements.
    static double part(const Work& work, double most);
    /// Moves an object by a part of its displacements.
    void move(std::size_t object, Real part, std::vector<Vec4<Real>>& positions) const;

private:
    std::shared_ptr<const Model> model_;
    std::vector<Vec4<Real>> ahead_;                  // positions after the displacements [m]
    std::vector<Vec3<Real>> forces_, forces_ahead_;  // [N]
};

}  // namespace gelatin::cpu
