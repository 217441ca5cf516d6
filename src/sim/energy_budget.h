#pragma once

#include "model/model.h"

namespace gelatin {

/// Bounds the kinetic and elastic energy E that a scene's bodies can have together [J]: more is a numerical
/// error.
///
/// Elastic and contact forces only transfer or dissipate energy; external forces supply it. Forces f on
/// masses m have a power of at most sqrt(2 E) |f|, |f|^2 = sum f^2 / m, so sqrt(E) grows by at most |f| /
/// sqrt(2) per second. For gravity |f| = |g| sqrt(M), M the mass of all free nodes. Loads are assumed to act
/// all the time, pressures on faces of four times their area at rest. The energy that moving handles supply
/// is unknown: the budget must start anew afterwards.
///
/// Numbers are not exact, and bodies that start inside a collider are pushed out of it. So there is an
/// allowance: the energy of springs and tets at twice their length and of volumes compressed to zero, of
/// rigid bodies that move by their size in a sixtieth of a second, and a factor of ten. A simulation that
/// explodes multiplies its energy by a factor in each step, and soon exceeds that.
class EnergyBudget {
public:
    /// The energy of the whole scene at one moment.
    struct Account {
        double time = 0.0;       ///< [s]
        double energy = 0.0;     ///< kinetic and elastic [J]
        double potential = 0.0;  ///< gravity's [J], zero anywhere
    };

    /// @param start the account from which the balance starts
    EnergyBudget(const Model& model, const Account& start);

    /// The time from which the balance holds: that of the start, then that of the last account noted [s].
    double time() const { return latest_.time; }

    /// The largest energy that all bodies can have at this time [J].
    double most_at(double time) const;

    /// The largest energy that they can have at this account, from what gravity has actually supplied since
    /// the start and what loads can have supplied [J].
    double most_for(const Account& now) const;

    /// Makes later bounds start from this account, which was found valid; they are then narrower.
    void note(const Account& now);

    /// Starts the balance anew.
    void restart(const Account& start);

private:
    double root_at(double time) const;        // largest sqrt(E) [sqrt(J)]
    double work_of_loads(double time) const;  // the largest since the start [J]

    double allowance_;             // [J]
    double gravity_drive_;         // largest rate of sqrt(E) by gravity [sqrt(J) / s]
    double load_drive_;            // the same by loads
    double given_by_loads_ = 0.0;  // of loads up to the latest account, at most [J]
    Account start_, latest_;
};

}  // namespace gelatin
