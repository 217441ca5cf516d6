#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "cpu/implicit/rigid_level.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// How nodes go on from the step before. BDF2 for steps of any length: with v_1 one step before, whose length
/// was h_1, and w = h / h_1,
///   y = x + c s + h' (v + c (v - v_1) + h' g),  c = w^2 / (1 + 2 w),  h' = h (1 + w) / (1 + 2 w).
/// Implicit Euler's scheme is that of w = 0. Then m / h'^2 (x' - y) is what inertia resists with. For s = x -
/// x_1 stands h_1 (v + v_1) / 2, which needs no positions of earlier steps, and of a node that was stopped
/// none.
template <class Real>
class TimeScheme {
public:
    struct Scheme {
        Real past = 0, step = 0;  ///< c, h' [s]
        Real damping = 0;         ///< the least damping time [s]
    };

    explicit TimeScheme(std::shared_ptr<const Model> model);

    /// Nodes were set from outside.
    void forget() { last_step_ = Real(0); }
    void archive(Archive& archive);
    /// After it. @param nodes where the next step begins @param earlier_velocities v_1 and step h_1 of the
    /// last one
    void go_on(const Nodes<Real>& nodes, std::span<const Vec4<Real>> earlier_velocities, Real step);

    /// A step begins.
    void begin(const Nodes<Real>& previous);
    /// Whether BDF2 is stable in a step of this length [s].
    bool can_go_on(Real step) const;
    /// Chooses that of an object, for a step of this length. @param goes_on by BDF2
    void set(std::size_t object, Real step, bool goes_on, Real damping);
    const Scheme& of(std::size_t object) const { return schemes_[object]; }
    /// y - x of a node [m]. @param acceleration g [m/s^2]
    Vec3<Real> target(const Nodes<Real>& previous, std::size_t node, const Vec3<Real>& acceleration) const;
    /// At the end, if it was displaced by so much [m/s].
    Vec3<Real> velocity(const Nodes<Real>& previous, std::size_t node, const Vec3<Real>& displacement) const;
    /// Momentum and angular momentum of free bodies, of which what was not solved would lose some, change by
    /// what acts on them. @param forces of all but elements and gravity [N], shape [nodes]
    void keep_momenta(const RigidLevel<Real>& rigid, std::span<const Vec3<Real>> forces,
                      Nodes<Real>& current) const;
    /// It was made.
    void end(const Nodes<Real>& previous, Real step);

    Real last_step() const { return last_step_; }  ///< h_1, 0: there is none [s]

private:
    // [kg m/s]; about the centre of mass [kg m^2/s].
    struct Momenta {
        glm::dvec3 linear{0.0}, angular{0.0};
    };
    Vec3<Real> went(const Nodes<Real>& previous, std::size_t node) const;
    double mass_of(std::size_t node, const Vec4<Real>& position) const;
    Momenta momenta(std::size_t body, std::span<const Vec4<Real>> positions,
                    std::span<const Vec4<Real>> velocities) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> object_of_;  // by node
    std::vector<Scheme> schemes_;           // by object
    Real last_step_ = 0;
    std::vector<Vec4<Real>> earlier_velocities_;      // v_1
    std::vector<Momenta> momenta_, earlier_momenta_;  // of bodies, when this step and the last one began
};

}  // namespace gelatin::cpu
