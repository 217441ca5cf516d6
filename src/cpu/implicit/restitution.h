#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/archive.h"
#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/rigid_level.h"
#include "cpu/implicit/rigid_part.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Restitution. Bodies bounce by their elasticity, of which steps leave little where bodies are stiff: those
/// that end an impact more slowly than with the restitution times the speed at which they met get that speed,
/// as rigid bodies.
template <class Real>
class Restitution {
public:
    Restitution(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// A step that was made.
    struct Step {
        double length, resting_speed;  ///< [s]; what meets more slowly stays [m/s]
        std::span<const ContactRow<Real>> rows;
        std::span<const Vec3<Real>> displacements;  ///< [m], shape [nodes]
        const Nodes<Real>& previous;
        /// Of bodies, when it began and when it has ended [J], shape [bodies].
        std::span<const double> energies_before, energies_after;
    };
    /// @param rigid of the step @param current velocities of free bodies change @return whether any did
    bool run(const Step& step, const RigidLevel<Real>& rigid, Nodes<Real>& current);
    void forget() { meetings_.clear(); }
    void archive(Archive& archive) { archive.map(meetings_); }

private:
    // In a step, times the force: how fast they leave each other before and after it.
    struct Pressing {
        double force = 0.0, before = 0.0, after = 0.0;
    };
    // Of two objects, or of a plane and a body, from when they first press each other.
    struct Meeting {
        double approach = 0.0, time = 0.0;  // when they met [m/s]; since [s]
        double energy = 0.0;                // of bodies among them, when they met [J]
        double size = 0.0;                  // of all impulses on the second [N s]
        glm::dvec3 impulse{0.0};            // their sum
        // Times their sizes: where, from the centre of a body of the two that is free, the second if both
        // are; the velocity of what is not free.
        glm::dvec3 arm{0.0}, held{0.0};
        Pressing pressing;
    };
    struct Side {
        std::size_t object;
        double sign;
        RigidPart<Real> body;
    };
    // Of a meeting that may be over: bodies that are free, and where and how fast they leave each other.
    struct Impact {
        std::vector<Side> sides;
        glm::dvec3 normal{0.0}, point{0.0};
        double apart = 0.0, mobility = 0.0;  // [m/s], [1/kg]
    };
    using Pair = std::pair<std::size_t, std::size_t>;  // of a plane: the objects' number and its own

    void note(const Step& step, const RigidLevel<Real>& rigid, const Nodes<Real>& current);
    Impact find_impact(const Pair& pair, const Meeting& meeting, const RigidLevel<Real>& rigid,
                       const Nodes<Real>& current) const;
    void strike(const Impact& impact, double speed, Nodes<Real>& current) const;
    double restitution_of(const Pair& pair) const;
    bool is_free_body(std::size_t object, const RigidLevel<Real>& rigid) const {
        return object < model_->body_count() && rigid.is_free(object);
    }

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::map<Pair, Meeting> meetings_;
};

}  // namespace gelatin::cpu
