#include "cpu/drive/apply_kinematics.h"

#include <glm/mat3x3.hpp>

namespace gelatin::cpu {
namespace {

// map arm + center, with the map in three columns.
template <class Real>
Vec3<Real> place(const glm::vec4& x, const glm::vec4& y, const glm::vec4& z, const glm::vec4& center,
                 const Vec3<Real>& arm) {
    const glm::mat<3, 3, Real> map{Vec3<Real>(x), Vec3<Real>(y), Vec3<Real>(z)};
    return map * arm + Vec3<Real>(center);
}

}  // namespace

template <class Real>
void apply_kinematics(const Model& model, std::span<const HandleMotion> motions,
                      std::span<const NodeMotion> animated, Nodes<Real>& nodes) {
    for (const HandleNode& held : model.handle_nodes) {
        const HandleMotion& motion = motions[held.handle];
        Vec4<Real>& position = nodes.positions[held.node];
        Vec4<Real>& velocity = nodes.velocities[held.node];
        if (motion.center.w == 0.0f) {
            position.w = static_cast<Real>(held.arm.w);
            continue;
        }
        if (held.animated != packing::kNone) {
            const NodeMotion& own = animated[held.animated];
            position = Vec4<Real>(Vec3<Real>(own.start), Real(0));
            velocity = Vec4<Real>(Vec3<Real>(own.velocity), velocity.w);
            continue;
        }
        const Vec3<Real> arm(held.arm);
        position = Vec4<Real>(place(motion.map_x, motion.map_y, motion.map_z, motion.center, arm), Real(0));
        velocity =
            Vec4<Real>(place(motion.rate_x, motion.rate_y, motion.rate_z, motion.velocity, arm), velocity.w);
    }
}

template void apply_kinematics<float>(const Model&, std::span<const HandleMotion>,
                                      std::span<const NodeMotion>, Nodes<float>&);
template void apply_kinematics<double>(const Model&, std::span<const HandleMotion>,
                                       std::span<const NodeMotion>, Nodes<double>&);

}  // namespace gelatin::cpu
