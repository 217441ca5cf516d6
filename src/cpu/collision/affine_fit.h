#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>

#include "cpu/collision/axis_box.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// An affine map of an object's rest shape, x = center + map X. GPU twin:
/// shaders/sim/collision/affine_fit.glsl.
template <class Real>
struct AffineFit {
    glm::mat<3, 3, Real> map{0};
    Vec3<Real> center{0};   ///< [m]
    Vec3<Real> origin{0};   ///< present position of the object's first node [m]
    Real half_stretch = 0;  ///< half of a lower bound of the map's smallest stretch
    Real rounding = 0;      ///< rounding error of a distance [m]

    /// The distance of a node from where the map places it, rounded up [m].
    Real deviation(const Vec3<Real>& position, const Vec3<Real>& rest_offset) const {
        return glm::distance(position - center, map * rest_offset) + rounding;
    }

    /// The same map, displaced with the object's first node, which is now at `now`. @param box of the object
    AffineFit moved(const Vec3<Real>& now, const RestShape& rest, const AxisBox<Real>& box) const {
        AffineFit fit = *this;
        fit.center += now - origin;
        fit.origin = now;
        const Vec3<Real> farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
        fit.rounding = Real(32) * std::numeric_limits<Real>::epsilon() *
                       (farthest.x + farthest.y + farthest.z + static_cast<Real>(rest.inverse_moment_x.w));
        return fit;
    }
};

/// The least-squares fit to the nodes. GPU twin: shaders/sim/collision/fit_rest_shapes.comp.
/// @param box of the object
template <class Real>
AffineFit<Real> fit_rest_shape(const Model& model, std::uint32_t object,
                               std::span<const Vec4<Real>> positions, const AxisBox<Real>& box) {
    const Range& nodes = model.objects[object].nodes;
    const RestShape& rest = model.rest_shapes.objects[object];
    const Vec3<Real> origin(positions[nodes.first]);
    glm::mat<3, 3, Real> moment(0);
    Vec3<Real> sum(0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const Vec3<Real> x = Vec3<Real>(positions[n]) - origin;
        moment += glm::outerProduct(x, Vec3<Real>(model.rest_shapes.offsets[n]));
        sum += x;
    }
    AffineFit<Real> fit;
    fit.map =
        moment * glm::mat<3, 3, Real>(Vec3<Real>(rest.inverse_moment_x), Vec3<Real>(rest.inverse_moment_y),
                                      Vec3<Real>(rest.inverse_moment_z));
    fit.center = origin + sum / static_cast<Real>(nodes.count);
    // The smallest singular value is at least |det| 2 / |map|^2 (Frobenius), by the means of the other two.
    const Real square = glm::dot(fit.map[0], fit.map[0]) + glm::dot(fit.map[1], fit.map[1]) +
                        glm::dot(fit.map[2], fit.map[2]);
    fit.half_stretch = square > Real(0) ? std::abs(glm::determinant(fit.map)) / square : Real(0);
    fit.origin = origin;
    return fit.moved(origin, rest, box);
}

}  // namespace gelatin::cpu
