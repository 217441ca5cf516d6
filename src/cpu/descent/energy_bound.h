#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contacts.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Keeps the energy of bodies that meet from rising (docs/contact.md). A step of implicit Euler that is
/// solved loses energy, but few sweeps of it can leave stiff bodies with many times the energy that there
/// was. What counts is the sum over an island of what bodies have: kinetic, elastic, of gravity and loads,
/// and what their contacts are to give back. Islands with nodes that something else moves have no such bound.
template <class Real>
class EnergyBound {
public:
    /// What a step begins with.
    struct Start {
        double length;                            ///< of the step [s]
        const Nodes<Real>& nodes;                 ///< where the last step led to
        std::span<const Vec4<Real>> starts;       ///< as of StepState; must stay where they are until its end
        std::span<const Vec4<Real>> load_forces;  ///< [N], or empty
        std::span<const std::uint32_t> pulled;    ///< nodes that hands have
    };

    explicit EnergyBound(std::shared_ptr<const Model> model);

    /// To be called where bodies were put elsewhere.
    void restart();

    /// To be called before the first part of a divided step: of what parts have lost, later ones of the same
    /// step may bring it back, as vibrations do; after it no more than contacts hold.
    void begin_parts(const Contacts<Real>& contacts);
    void begin(const Start& start, const Contacts<Real>& contacts);

    /// To be called when moves were made, and again after each further move.
    /// @param positions where they lead
    void measure(std::span<const Vec4<Real>> positions);

    /// Finds ends at which islands have no more energy than when the step began: their bodies go back from
    /// what deforms them more than then, all by the same part, to the nearest rigid motion. That keeps their
    /// momentum, and their angular momentum about their centres. @pre measure()
    /// @param acting null: each body by itself
    /// @param ends output: those of bodies that are to move, others as `positions`
    /// @return whether any are
    bool plan(const Contacts<Real>* acting, std::span<const Vec4<Real>> positions,
              std::vector<Vec4<Real>>& ends) const;

    /// Ends a step. What others keep from going back, and still has too much energy, is slowed down, to no
    /// less motion than it had: first what bodies do besides their rigid motions, then these besides the
    /// island's. Momentum and angular momentum of the island stay. @pre measure(), contacts have ended the
    /// step
    /// @param velocities input and output: as positions have it, without restitution [m/s]
    void end(const Contacts<Real>* acting, std::span<const Vec4<Real>> positions,
             std::span<Vec4<Real>> velocities);

private:
    // Of a body [J].
    struct Account {
        double credit = 0.0;    // of what was lost before, which may come back; negative: owed
        double elastic = 0.0;   // at the end of the last step
        bool is_known = false;  // whether that is
        double kinetic_then = 0.0, elastic_then = 0.0;  // when the step began
        double kinetic_now = 0.0, elastic_now = 0.0;    // at its end
        double work = 0.0;                              // of gravity and loads since
        double before() const { return kinetic_then + elastic_then; }
        double now() const { return kinetic_now + elastic_now; }
    };
    using Group = std::vector<std::uint32_t>;  // bodies of an island
    std::vector<Group> closed_groups(const Contacts<Real>* acting) const;
    double most_energy(const Group& group) const;
    double settling(const Group& group) const;
    double little(const Group& group) const;
    bool move_back(const Group& group, std::span<const Vec4<Real>> positions,
                   std::vector<Vec4<Real>>& ends) const;
    std::vector<glm::dvec3> rigid_motion(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    Account at(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    void slow_down(const Group& group, double most_kinetic, std::span<const Vec4<Real>> positions,
                   std::span<Vec4<Real>> velocities) const;

    std::shared_ptr<const Model> model_;
    std::vector<double> masses_;         // by object [kg]
    std::vector<Account> accounts_;      // by object
    std::vector<std::uint8_t> is_open_;  // by object: something unknown moves it
    double length_ = 0.0;                // of the step [s]
    std::span<const Vec4<Real>> starts_, load_forces_;
};

}  // namespace gelatin::cpu
