#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// Reports which colliders and held bodies cannot follow their motion because bodies leave them no room
/// (docs/contact.md). They wait; nothing is pushed through anything. Those whose time goes on meanwhile are
/// reported once, those that stop (WhenBlocked) each time that they stop and that they have moved on.
class Standstills {
public:
    /// What has stopped is reported to move again when nothing has blocked it for so long [s]; until then it
    /// has not stopped again.
    static constexpr double kMovesOn = 0.25;

    /// @param solver whose last step ended at `time` [s]
    /// @param held_up what Solver::held_up finds then @param delays of handles [s], shape [handles]
    /// @return a line for each that is to be reported
    std::vector<std::string> look(const Model& model, Solver& solver, std::span<const std::uint32_t> held_up,
                                  std::span<const double> delays, double time);

    /// All are reported again.
    void restart() {
        told_.clear();
        stopped_.clear();
    }

private:
    std::set<std::uint32_t> told_;             // objects
    std::map<std::uint32_t, double> stopped_;  // handles reported, and until when they were blocked [s]
};

}  // namespace gelatin
