#pragma once

#include "model/model.h"

namespace gelatin {

/// How much kinetic and elastic energy E a scene's bodies can have between them [J]: more is a numerical
/// error.
///
/// Elastic and contact forces only move energy about or take it away; what drives bodies from outside puts it
/// in. Gravity's power is g . P <= |g| sqrt(2 M E), so sqrt(E) grows by no more than |g| sqrt(M / 2) a
/// second, M the mass of what can move. What handles and loads put in is not accounted for: scenes that have
/// any are held against numbers that are not finite alone.
///
/// Numbers are not exact, and bodies that start inside a collider are pushed out of it, so there is an
/// allowance: the energy of springs at twice their length and of volumes pressed to nothing, and a factor of
/// ten. A simulation that explodes multiplies its energy by a factor in each step, and is soon beyond that.
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

    /// What all bodies can have at this time [J].
    double most_at(double time) const;

    /// What they can have there, going by what gravity has really given since the start [J].
    double most_for(const Account& now) const;

    /// From an account that was found right later bounds can start anew, and are narrower.
    void note(const Account& now) { latest_ = now; }

private:
    double allowance_;  // [J]
    double drive_;      // how fast sqrt(E) can grow [sqrt(J) / s]
    Account start_, latest_;
};

}  // namespace gelatin
