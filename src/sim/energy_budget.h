#pragma once

#include "model/model.h"

namespace gelatin {

/// How much kinetic and elastic energy E a scene's bodies can have between them [J]: more is a numerical
/// error.
///
/// Elastic and contact forces only move energy about or take it away; what drives bodies from outside puts it
/// in. Forces f on masses m have a power of no more than sqrt(2 E) |f|, |f|^2 = sum f^2 / m, so sqrt(E) grows
/// by no more than |f| / sqrt(2) a second: for gravity |f| = |g| sqrt(M), M the mass of what can move, and
/// loads are taken to act all the time, pressures on faces of four times their area at rest. What handles put
/// in while they move is not accounted for: the budget must start anew then.
///
/// Numbers are not exact, and bodies that start inside a collider are pushed out of it, so there is an
/// allowance: the energy of springs and tets at twice their length and of volumes pressed to nothing, and a
/// factor of ten. A simulation that explodes multiplies its energy by a factor in each step, and is soon
/// beyond that.
class EnergyBudget {
public:
    /// What the whole scene had at one moment.
    struct Account {
        double time = 0.0;       ///< [s]
        double energy = 0.0;     ///< kinetic and elastic [J]
        double potential = 0.0;  ///< gravity's [J], zero anywhere
    };

    /// @param start from here on energy is accounted for
    EnergyBudget(const Model& model, const Account& start);

    /// Accounted for are the times from here on: the start's, and then that of the last account noted [s].
    double time() const { return latest_.time; }

    /// What all bodies can have at this time [J].
    double most_at(double time) const;

    /// What they can have there, going by what gravity has really given since the start and loads can have
    /// [J].
    double most_for(const Account& now) const;

    /// From an account that was found right later bounds can start anew, and are narrower.
    void note(const Account& now);

    /// Accounts begin anew.
    void restart(const Account& start);

private:
    double root_at(double time) const;        // most sqrt(E) [sqrt(J)]
    double work_of_loads(double time) const;  // the most since the start [J]

    double allowance_;             // [J]
    double gravity_drive_;         // how fast gravity lets sqrt(E) grow at most [sqrt(J) / s]
    double load_drive_;            // how fast loads
    double given_by_loads_ = 0.0;  // up to the latest account, at most [J]
    Account start_, latest_;
};

}  // namespace gelatin
