#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/stages.h"
#include "bench/timed_steps.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// Three balls of one material.
struct MaterialCase {
    std::string material;  ///< "springs, nu 0.25"
    std::shared_ptr<const Model> model;

    /// The balls compressed to 0.95 along y, so that no force is zero.
    State start() const;
    /// Of this solver: a sixtieth of a second for the implicit one, else half the largest stable one.
    StepSettings settings(SolverKind solver) const;
};

/// The same balls, of a radius of 0.5 m and apart from each other, of each material. Ratios refer to the
/// first one: fitted springs at a Poisson's ratio of 1/4, which need no volume term.
std::vector<MaterialCase> material_cases(int frequency);

/// Each backend; the CPU's with one thread, with two and with all.
std::vector<StageSystem> material_systems(bool use_gl);

}  // namespace gelatin
