#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "cpu/descent/motion.h"
#include "cpu/object_pieces.h"
#include "model/model.h"
#include "model/spring_packing.h"

namespace gelatin::cpu {

/// Newton's system of the rigid motions of an island's bodies, with the contacts between them, friction among
/// these (docs/contact.md, "Joint rigid motions").
class IslandSystem {
public:
    struct Body {
        explicit Body(std::uint32_t of) : object(of) {}

        std::uint32_t object;
        glm::dvec3 origin{0.0};  ///< centre of mass [m]
        // Of all that acts on it but contacts with others:
        MotionMatrix matrix = MotionMatrix::Zero();
        Motion force = Motion::Zero();
        double stiffness = 0.0;  ///< sum of m / h^2 [N/m]
    };

    /// A contact of bodies, which are numbered within the island; kNoNode: what is held.
    struct Touch {
        std::array<std::uint32_t, 2> bodies{kNoNode, kNoNode};
        std::array<glm::dvec3, 2> arms{};  ///< of the nearest points, from the bodies' origins [m]
        glm::dvec3 normal{0.0};            ///< from the first to the second, unit
        double gap = 0.0, reach = 0.0;     ///< [m]
        double stiffness = 0.0;            ///< [N/m]
        double least = 0.0;                ///< gap from which on inwards the force grows linearly [m]
        double friction = 0.0;             ///< Coulomb's coefficient
        glm::dvec3 hold{0.0};              ///< what would hold the first if nothing slid [N]
        double limit = 0.0;                ///< of friction, by what presses [N]
        glm::dvec3 carried{0.0};           ///< how far the second goes beside the first by what is held [m]

        /// As contact_force and contact_hessian, but linear from the least gap on [N], [N/m].
        double force_at(double gap_there) const;
        double hessian_at(double gap_there) const;
        /// How a motion of its body moves a side [m].
        glm::dvec3 displacement(std::size_t side, const Motion& motion) const {
            return glm::dvec3(motion(0), motion(1), motion(2)) +
                   glm::cross(glm::dvec3(motion(3), motion(4), motion(5)), arms[side]);
        }
    };

    std::vector<Body> bodies;
    std::vector<Touch> touches;  ///< those of the same two bodies beside each other; they follow the motions
    bool is_held = false;        ///< something that is held is part of the island
    bool is_outside_touched = false;  ///< a body is in contact with a collider

    /// How the second side of a contact goes beside the first on the way of its bodies [m].
    static glm::dvec3 apart(const Touch& touch, const std::vector<Motion>& way);

    /// Changes the motion of a body, by its number, so that it stays outside of planes.
    /// @return whether it led into one
    using Land = std::function<bool(std::size_t, Motion&)>;
    /// The motions of all bodies to where the objective is least, to first order in rotations.
    /// @param land may be called on several threads; none: nothing is in the way
    std::vector<Motion> find_motions(const Land& land = {});

private:
    // What contacts of two bodies add.
    struct Sums {
        std::array<MotionMatrix, 2> own{MotionMatrix::Zero(), MotionMatrix::Zero()};
        MotionMatrix across = MotionMatrix::Zero();  // rows of the first body, columns of the second
        std::array<Motion, 2> forces{Motion::Zero(), Motion::Zero()};

        void add(const Sums& other);
    };
    struct Coupling {
        std::array<std::uint32_t, 2> bodies{kNoNode, kNoNode};
        Range touches;
    };
    using Motions = std::vector<Motion>;

    void find_couplings();
    Sums sum_touches(const Coupling& coupling, const Range& of) const;
    void assemble();
    Motions newton_step(double& least_residual) const;
    bool is_carried() const;
    std::vector<double> carried_along(const Motions& way);
    static void shorten(Motions& way, const std::vector<double>& parts);
    void move(const Motions& way);
    bool leads_far(const Motions& way) const;
    Motions landed(const Land& land);
    Motion mean_translation(const Motions& motions) const;
    Motion free_translation() const;
    Motions product(const Motions& motions) const;

    // A body's part in a coupling.
    struct Use {
        std::uint32_t coupling;
        std::size_t side;
    };
    // In the order of the couplings, so that sums do not depend on the number of threads.
    std::span<const Use> uses_of(std::size_t body) const {
        return {uses_.data() + use_starts_[body], use_starts_[body + 1] - use_starts_[body]};
    }

    Motions motions_;  // so far
    std::vector<Coupling> couplings_;
    ObjectPieces pieces_;     // of their touches
    std::vector<Sums> sums_;  // of each coupling
    std::vector<Use> uses_;   // body by body
    std::vector<std::uint32_t> use_starts_;
    // With contacts, after the motions so far, by body:
    std::vector<MotionMatrix> matrices_, inverses_;
    Motions forces_;
};

}  // namespace gelatin::cpu
