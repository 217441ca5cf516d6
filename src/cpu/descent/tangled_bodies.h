#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "cpu/descent/step_objective.h"
#include "cpu/nodes.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// What a body does without of a guess that it cannot come back from within few sweeps.
enum class GuessLimit : std::uint8_t {
    all,     ///< where it tangles the body, all of it
    part,    ///< where it tangles the body, the part that takes more energy than the body has
    energy,  ///< that part of any guess
};

/// Bodies that the guess of a step would tangle, and those that are tangled where it begins.
template <class Real>
class TangledBodies {
public:
    struct End {
        std::span<const Vec4<Real>> starts, positions;  ///< of the step [m]
        std::span<const Vec4<Real>> before;             ///< velocities when it began [m/s]
        std::span<const Vec4<Real>> load_forces;        ///< [N], or empty
        const ContactForces& contacts;
    };

    explicit TangledBodies(std::shared_ptr<const Model> model)
        : model_(std::move(model)), is_tangled_(model_->objects.size()) {}

    /// Makes a body move as a rigid one, with the momentum and the angular momentum, about its centre, that
    /// its velocities would have with the nodes elsewhere: it was to get there, but others are in the way.
    /// With the velocities alone, a body that is stretched in each step would turn faster with each.
    /// @param shape where its nodes would be, shape [nodes]
    void move_rigidly(std::uint32_t object, std::span<const Vec4<Real>> shape, Nodes<Real>& nodes) const;

    /// A guess that tangles a body can hold any energy, which few sweeps would not take out again: the body
    /// starts where it was. A step of a single sweep would lose a third of its motion so. So bodies whose
    /// limit is another go on as rigid ones, and from there the largest part of the way to the guess, of
    /// halves, at which the objective is no more than there: what they have as elastic energy, and as motion
    /// besides a rigid one.
    /// @param limits by object
    /// @param positions input: the guess; output: where the step starts its moves
    void shorten_guess(const StepObjective<Real>& objective, std::span<const GuessLimit> limits,
                       std::vector<Vec4<Real>>& positions);

    /// Whether a body was tangled where the step began. @pre shorten_guess()
    bool was_tangled(std::size_t object) const { return is_tangled_[object] != 0; }

    /// Keeps bodies that were tangled from gaining energy. Few sweeps of them are far from a minimum: what
    /// they leave as motion can be more than what tets and contacts had to give, in each step. What a body
    /// does besides its rigid motion is slowed down until
    ///   K_1 + E(x_1) <= K_0 + E(x_0) + sum_i f_i . (x_1i - x_0i)
    /// holds, with the forces of gravity, loads and contacts where the step ends, as for every step of
    /// implicit Euler that is solved. Momentum and angular momentum stay as they are.
    /// @param objects nothing else but these forces acts on their nodes
    void slow_down(const End& end, std::span<const std::uint32_t> objects,
                   std::span<Vec4<Real>> velocities) const;

private:
    void move_on_rigidly(const StepObjective<Real>& objective, const Range& nodes,
                         std::span<Vec4<Real>> positions) const;
    double objective_of(const StepObjective<Real>& objective, const ModelObject& object,
                        const std::vector<Vec4<Real>>& positions) const;
    void slow_down(const End& end, const ModelObject& object, std::span<Vec4<Real>> velocities) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint8_t> is_tangled_;  // by object, where the step began
};

}  // namespace gelatin::cpu
