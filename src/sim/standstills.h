#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// Tells, once for each, which colliders and held bodies cannot follow their motion because bodies leave them
/// no room (docs/contact.md). They wait; nothing is pushed through anything.
class Standstills {
public:
    /// @param solver whose last step ended at `time` [s]
    /// @return a line for each that was not told before
    std::vector<std::string> look(const Model& model, const Solver& solver, double time);

    /// They are told again.
    void restart() { told_.clear(); }

private:
    std::set<std::uint32_t> told_;  // objects
};

}  // namespace gelatin
