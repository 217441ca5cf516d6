#pragma once

#include "cpu/collision/colliders.h"
#include "cpu/explicit/advance_nodes.h"

namespace gelatin::cpu {

/// One node's part of a pass, given the force of its springs [N]. A node without inverse mass moves with its
/// velocity. GLSL twin: sim/explicit/integrate_node.glsl. Written for four components, of which the last is
/// passed through, so that compilers use one vector.
template <class Real>
inline void integrate_node(const Pass<Real>& pass, std::uint32_t n, const Vec3<Real>& force) {
    using V4 = Vec4<Real>;
    const V4 base_position = pass.base_positions[n];
    const V4 base_velocity = pass.base_velocities[n];
    const Real inverse_mass = base_position.w;
    if (inverse_mass == Real(0)) {
        const Real step = pass.last ? pass.step : pass.next_step;
        pass.out_positions[n] =
            base_position + step * V4(base_velocity.x, base_velocity.y, base_velocity.z, 0);
        pass.out_velocities[n] = base_velocity;
        return;
    }
    V4 rate = pass.velocities[n];
    rate.w = Real(0);
    V4 total(force, 0);
    if (pass.load_forces != nullptr) total += pass.load_forces[n];
    const V4 acceleration = V4(pass.gravity, 0) + inverse_mass * total;

    V4 sum_rate = pass.weight * rate;
    V4 sum_acceleration = pass.weight * acceleration;
    if (!pass.first) {
        sum_rate += pass.sum_positions[n];
        sum_acceleration += pass.sum_velocities[n];
    }
    if (!pass.last) {
        pass.sum_positions[n] = sum_rate;
        pass.sum_velocities[n] = sum_acceleration;
        pass.out_positions[n] = base_position + pass.next_step * rate;
        pass.out_velocities[n] = base_velocity + pass.next_step * acceleration;
        return;
    }
    V4 velocity = base_velocity + pass.step * sum_acceleration;
    if (pass.semi_implicit) sum_rate = V4(velocity.x, velocity.y, velocity.z, 0);
    V4 position = base_position + pass.step * sum_rate;
    if (!pass.model.colliders.empty())
        resolve_colliders<Real>(pass.model.colliders, pass.resting_speed, position, velocity);
    pass.out_positions[n] = position;
    pass.out_velocities[n] = velocity;
}

}  // namespace gelatin::cpu
