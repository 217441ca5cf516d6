#include "cpu/contact/partial_turn.h"

#include <glm/geometric.hpp>

#include "model/nearest_rotation.h"

namespace gelatin::cpu {
namespace {

// Of a body's lengths.
constexpr double kLeastShrinking = 1e-4;

}  // namespace

template <class Real>
bool turn_in_part(const Model& model, std::uint32_t object, double part,
                  std::span<const Vec4<Real>> positions, std::span<Vec4<Real>> ends) {
    const Range& nodes = model.objects[object].nodes;
    glm::dvec3 center(0.0), end(0.0);
    double mass = 0.0;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const auto own = static_cast<double>(model.masses[n]);
        center += own * glm::dvec3(positions[n]);
        end += own * glm::dvec3(ends[n]);
        mass += own;
    }
    center /= mass;
    end /= mass;
    glm::dmat3 moment(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        moment += static_cast<double>(model.masses[n]) *
                  glm::outerProduct(glm::dvec3(ends[n]) - end, glm::dvec3(positions[n]) - center);
    const glm::dquat rotation = smallest_nearest_rotation(moment);
    // On the chord of an angle a, nodes come nearer to the axis by the part 2 p (1 - p) sin^2(a / 2).
    const glm::dvec3 axis(rotation.x, rotation.y, rotation.z);
    if (2.0 * part * (1.0 - part) * glm::dot(axis, axis) < kLeastShrinking) return false;
    const glm::dmat3 turned = glm::mat3_cast(glm::slerp(glm::dquat(1.0, 0.0, 0.0, 0.0), rotation, part));
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 arm = glm::dvec3(positions[n]) - center;
        ends[n] = Vec4<Real>(Vec3<Real>(end + arm + (turned * arm - arm) / part), ends[n].w);
    }
    return true;
}

template bool turn_in_part<float>(const Model&, std::uint32_t, double, std::span<const Vec4<float>>,
                                  std::span<Vec4<float>>);
template bool turn_in_part<double>(const Model&, std::uint32_t, double, std::span<const Vec4<double>>,
                                   std::span<Vec4<double>>);

}  // namespace gelatin::cpu
