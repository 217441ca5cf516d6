#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "cpu/contact/tuning.h"
#include "cpu/implicit/rigid_level.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// How nodes go on from the step before: Newmark's method with weighted inertia (Wood, Bossak and Zienkiewicz
/// 1980). With a_0 the acceleration at the step's start,
///   x' = x + h v + h^2 ((1/2 - beta) a_0 + beta a'),  v' = v + h ((1 - gamma) a_0 + gamma a'),
///   m ((1 + alpha) a' - alpha a_0) = f' + m g,  beta = (1 + alpha)^2 / 4,  gamma = 1/2 + alpha,
/// so m / h'^2 (x' - y) is what inertia resists with, for
///   y = x + h v + h'^2 g + (1 - alpha) / 4 h^2 a_0,  h'^2 = (1 + alpha) / 4 h^2.
/// Implicit Euler's scheme is that of beta = gamma = 1 and alpha = 0, without a_0, in which h' = h.
template <class Real>
class TimeScheme {
public:
    struct Scheme {
        Real length = 0, step = 0;            ///< h, h' [s]
        Real past = 0;                        ///< what a_0 counts by: 1, or 0 with Euler's scheme
        Real alpha = 0, beta = 1, gamma = 1;  ///< as above
        Real damping = 0;                     ///< the least damping time [s]
        bool is_whole = false;                ///< momenta go by Euler's scheme, whatever nodes do
    };

    explicit TimeScheme(std::shared_ptr<const Model> model);

    /// Nodes were set from outside.
    void forget();
    void archive(Archive& archive);
    /// After it. @param nodes where the next step begins @param earlier_velocities a step before, whose
    /// length was so much [s]
    void go_on(const Nodes<Real>& nodes, std::span<const Vec4<Real>> earlier_velocities, Real step);

    /// A step begins.
    void begin(const Nodes<Real>& previous);
    /// Whether a step can follow how a body deforms in an impact: a pressure wave takes longer to pass
    /// through it.
    bool resolves(std::size_t body, Real step) const { return wave_times_[body] > step; }
    bool has_past() const { return last_step_ > Real(0); }  ///< whether there is an a_0
    /// Euler's for an object, for a step of this length. @param damping the least damping time [s]
    void set(std::size_t object, Real step, Real damping);
    /// Or the other. @param left what it leaves of fast vibrations in a step, with their sign reversed
    void set_second_order(std::size_t object, Real step, double left = tuning::kLeftOfFast);
    const Scheme& of(std::size_t object) const { return schemes_[object]; }
    /// When all schemes are set. Of a force this scheme leaves a part to later steps, of a body and of what
    /// it touched alike. So where bodies that touched each other go on by different schemes, what is left is
    /// dropped for all of them. @param islands_of_bodies of each body the least one of its island
    /// @param whole islands of attached bodies: of their momenta nothing is left, as what they rotate by
    /// meanwhile would add to their angular momentum
    void tie(std::span<const std::uint32_t> islands_of_bodies, std::span<const std::uint8_t> whole);
    /// y - x of a node [m]. @param acceleration g [m/s^2]
    Vec3<Real> target(const Nodes<Real>& previous, std::size_t node, const Vec3<Real>& acceleration) const;
    /// At the end, if it was displaced by so much [m/s].
    Vec3<Real> velocity(const Nodes<Real>& previous, std::size_t node, const Vec3<Real>& displacement) const;
    /// Momentum and angular momentum of free bodies, of which what was not solved would lose some, change by
    /// what acts on them. The free ones of a group do so together: what a light one passes on from one side
    /// to the other would rotate it by its rounding. @param groups of each body the least one of its group
    /// @param forces of all but elements and gravity [N], shape [nodes]
    void keep_momenta(const RigidLevel<Real>& rigid, std::span<const std::uint32_t> groups,
                      std::span<const Vec3<Real>> forces, Nodes<Real>& current) const;
    /// It was made.
    void end(const Nodes<Real>& previous, const Nodes<Real>& current);

    Real last_step() const { return last_step_; }  ///< its length, 0: there is none [s]

private:
    // [kg m/s]; about the centre of mass [kg m^2/s].
    struct Momenta {
        glm::dvec3 linear{0.0}, angular{0.0};
    };
    // Of one body or several.
    struct Moving {
        Momenta momenta;
        glm::dvec3 center{0.0};  // [m]
        double mass = 0.0;       // [kg]

        void add(const Moving& more);
    };
    // By which a body's momenta go.
    Scheme of_momenta(std::size_t body) const;
    double mass_of(std::size_t node, const Vec4<Real>& position) const;
    Moving moving(std::size_t body, std::span<const Vec4<Real>> positions,
                  std::span<const Vec4<Real>> velocities) const;

    std::shared_ptr<const Model> model_;
    std::vector<Real> wave_times_;  // by body [s]
    std::vector<Scheme> schemes_;   // by object
    Real last_step_ = 0;
    std::vector<Vec3<Real>> accelerations_;        // a_0 [m/s^2]
    std::vector<std::uint32_t> tied_, next_tied_;  // of each body the least one with which it has left some
    std::vector<Moving> began_;                    // bodies when the step began
    std::vector<Momenta> rates_;                   // how fast theirs changed
};

}  // namespace gelatin::cpu
