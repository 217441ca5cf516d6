#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "cpu/drive/pulls.h"
#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/islands.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Energy of bodies and their contacts grows by what drives them alone. Steps gain some where forces change
/// much within them: what an island of bodies has gained is owed, and taken back from what they vibrate with,
/// which changes neither momentum nor angular momentum.
template <class Real>
class EnergyAccount {
public:
    explicit EnergyAccount(std::shared_ptr<const Model> model);

    /// A step that was made.
    struct Step {
        Real length;                          ///< [s]
        std::span<const Vec4<Real>> loads;    ///< [N], shape [nodes], or empty
        const Pulls<Real>* pulls;             ///< null: no hand holds anything
        std::span<const Vec3<Real>> on_held;  ///< by elements, where handles move nodes [N]; or empty
        std::span<const ContactRow<Real>> rows;
        std::span<const Vec3<Real>> displacements;  ///< [m], shape [nodes]
        const Islands& islands;
        std::span<const std::uint8_t> asleep;  ///< bodies of which nothing changes, shape [bodies]
        const Nodes<Real>&previous, &current;
    };

    /// @param drives of cavities until the next one: what they change the energy of gas by is no gain
    void begin(const Nodes<Real>& previous, std::span<const double> drives = {});
    /// Measures a step.
    /// @return what an island has gained beyond what drives it and what it vibrates with, as a part of its
    /// energy then; of all islands the most; 0 where none has, infinity where energies are not finite
    double measure(const Step& step);
    /// Then: takes what is owed, as far as bodies vibrate. @param islands, current of the step
    void settle(const Islands& islands, Nodes<Real>& current);
    /// Nodes were set from outside.
    void forget();
    void archive(Archive& archive);
    /// Nodes were moved since the beginning: what bodies gained by it is owed.
    void follow(const Nodes<Real>& nodes);
    /// Velocities, or which nodes are held, were set from outside: what is owed stays.
    void change() { is_known_ = false; }

    /// Of bodies, without contacts, at the beginning and at the end [J].
    std::span<const double> before() const { return before_; }
    std::span<const double> after() const { return after_; }
    /// When the last step has ended [J].
    double in_contacts() const;

private:
    double work_on_rows(const Step& step, const ContactRow<Real>& row) const;
    void find_energies(const Nodes<Real>& nodes, std::span<const std::uint8_t> asleep = {});
    void find_energy(std::size_t body, const Nodes<Real>& nodes);
    void find_contacts(const Step& step);
    void find_work(const Step& step);
    template <class Counts>
    void find_vibrations(const Step& step, const Counts& counts);

    std::shared_ptr<const Model> model_;
    std::vector<double> drives_;  // of cavities
    bool is_known_ = false;
    std::vector<double> potentials_, potentials_before_;  // of bodies [J]
    std::vector<glm::dvec3> momenta_;                     // of bodies [kg m/s]
    // Of bodies [J]: kinetic, elastic and potential, and of gas; kinetic and elastic; and what is too small
    // to count.
    std::vector<double> before_, after_, motions_, motions_before_, rounding_;
    // Of bodies' shares in contacts [J].
    std::vector<double> contacts_before_, contacts_at_start_, contacts_at_end_;
    std::vector<double> work_, debts_;  // [J]
    // What islands owe, and of it more than the slack; and what they and bodies vibrate with [J], [m/s].
    std::vector<double> owed_, dues_, vibrations_, of_bodies_;
    std::vector<Vec3<Real>> parts_;  // of nodes' velocities
};

}  // namespace gelatin::cpu
