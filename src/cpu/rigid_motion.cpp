#include "cpu/rigid_motion.h"

#include "cpu/node_terms.h"

namespace gelatin::cpu {
namespace {

// Of the mean moment of inertia, added to all three: nodes in one line or place have none about it.
constexpr double kLeastInertia = 1e-6;

}  // namespace

template <class Real>
RigidMotion nearest_rigid_motion(std::span<const Vec4<Real>> nodes, std::span<const Vec3<Real>> targets) {
    RigidMotion motion;
    double mass = 0.0;
    const auto mass_of = [&](std::size_t n) { return 1.0 / static_cast<double>(nodes[n].w); };
    const auto way_of = [&](std::size_t n) { return glm::dvec3(targets[n]) - glm::dvec3(nodes[n]); };
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        mass += mass_of(n);
        motion.center += mass_of(n) * glm::dvec3(nodes[n]);
        motion.shift += mass_of(n) * way_of(n);
    }
    motion.center /= mass;
    motion.shift /= mass;

    NodeTerms<double> turn;  // moment and inertia
    double trace = 0.0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const glm::dvec3 r = glm::dvec3(nodes[n]) - motion.center;
        turn.force += mass_of(n) * glm::cross(r, way_of(n));
        turn.hessian.add_identity(mass_of(n) * glm::dot(r, r));
        turn.hessian.add_outer(-mass_of(n), r);
        trace += 2.0 * mass_of(n) * glm::dot(r, r);
    }
    turn.hessian.add_identity(kLeastInertia * trace / 3.0);
    motion.turn = cayley_turn(solve(turn));
    return motion;
}

template RigidMotion nearest_rigid_motion<float>(std::span<const Vec4<float>>, std::span<const Vec3<float>>);
template RigidMotion nearest_rigid_motion<double>(std::span<const Vec4<double>>,
                                                  std::span<const Vec3<double>>);

}  // namespace gelatin::cpu
