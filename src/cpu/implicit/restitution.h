#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/rigid_level.h"
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
    };
    /// @param rigid of the step @param current velocities of free bodies change
    /// @param is_struck output: bodies whose velocities did, shape [bodies]
    /// @return whether any did
    bool run(const Step& step, const RigidLevel<Real>& rigid, Nodes<Real>& current,
             std::span<std::uint8_t> is_struck);
    void forget() { meetings_.clear(); }

private:
    // Sums over all that presses in a step, by force.
    struct Pressing {
        double force = 0.0, before = 0.0, after = 0.0;  // how fast they leave each other before and after it
        glm::dvec3 point{0.0}, held{0.0};               // where; velocity of a side that is not free
    };
    // Of two objects, or of a plane and a body, from when they first press each other.
    struct Meeting {
        double approach = 0.0, time = 0.0;               // when they met [m/s]; since [s]
        glm::dvec3 impulse{0.0}, point{0.0}, held{0.0};  // on the second [N s]; the last of all
        Pressing pressing;
    };
    using Pair = std::pair<std::size_t, std::size_t>;  // of a plane: the objects' number and its own

    void note(const Step& step, const RigidLevel<Real>& rigid, const Nodes<Real>& current);
    bool strike(const Pair& pair, const Meeting& meeting, const RigidLevel<Real>& rigid, Nodes<Real>& current,
                std::span<std::uint8_t> is_struck) const;
    double restitution_of(const Pair& pair) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::map<Pair, Meeting> meetings_;
};

}  // namespace gelatin::cpu
