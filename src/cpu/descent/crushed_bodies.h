#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "cpu/nodes.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// The elastic energy of a body, with that of flat tets [J].
template <class Real>
double body_energy(const Model& model, const ModelObject& object, std::span<const Vec4<Real>> positions);

/// Keeps bodies that are tangled where a step begins from gaining energy. Few sweeps of them are far from a
/// minimum: what they leave as motion can be more than what tets and contacts had to give, in each step. What
/// a body does besides its rigid motion is slowed down until
///   K_1 + E(x_1) <= K_0 + E(x_0) + sum_i f_i . (x_1i - x_0i)
/// holds, with the forces of gravity, loads and contacts where the step ends, as for every step of implicit
/// Euler that is solved. Momentum and angular momentum stay as they are.
template <class Real>
class CrushedBodies {
public:
    struct Step {
        std::span<const Vec4<Real>> starts, positions;  ///< [m]
        std::span<const Vec4<Real>> before;             ///< velocities when it begins [m/s]
        std::span<const Vec4<Real>> load_forces;        ///< [N], or empty
        const ContactForces& contacts;
    };

    explicit CrushedBodies(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

    /// @param objects that are tangled; nothing else but these forces acts on their nodes
    void run(const Step& step, std::span<const std::uint32_t> objects,
             std::span<Vec4<Real>> velocities) const;

private:
    void slow_down(const Step& step, const ModelObject& object, std::span<Vec4<Real>> velocities) const;

    std::shared_ptr<const Model> model_;
};

}  // namespace gelatin::cpu
