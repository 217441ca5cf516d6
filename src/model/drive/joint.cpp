#include "model/drive/joint.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace gelatin {

template <class Vector>
Frame frame_of(const CarriedFrame& carried, std::span<const Vector> values, bool are_positions) {
    std::array<glm::dvec3, 4> sums{};
    if (are_positions) sums = carried.at;
    for (std::uint32_t k = 0; k < carried.count; ++k)
        for (int c = 0; c < 4; ++c)
            sums[static_cast<std::size_t>(c)] += carried.weights[k][c] * glm::dvec3(values[carried.nodes[k]]);
    Frame frame{sums[0], {sums[1], sums[2], sums[3]}};
    if (are_positions && frame.axes[2] != glm::dvec3(0.0)) {  // of a distance there are none
        const glm::dvec3 z = glm::normalize(frame.axes[2]),
                         x = glm::normalize(frame.axes[0] - glm::dot(z, frame.axes[0]) * z);
        frame.axes = {x, glm::cross(z, x), z};
    }
    return frame;
}

double coordinate(const Joint& joint, const Frame& own, const Frame& other) {
    switch (joint.kind) {
        case Joint::Kind::hinge:
            return std::atan2(glm::dot(other.axes[1], own.axes[0]), glm::dot(other.axes[0], own.axes[0]));
        case Joint::Kind::slider:
            return glm::dot(own.point - other.point, other.axes[2]);
        case Joint::Kind::distance:
            return glm::distance(own.point, other.point);
        default:
            return 0.0;
    }
}

double coordinate_speed(const Joint& joint, const Frame& own, const Frame& other, const Frame& own_change,
                        const Frame& other_change) {
    const glm::dvec3 apart = own.point - other.point, change = own_change.point - other_change.point;
    switch (joint.kind) {
        case Joint::Kind::hinge:
            return glm::dot(own_change.axes[0], own.axes[1]) - glm::dot(other_change.axes[0], other.axes[1]);
        case Joint::Kind::slider:
            return glm::dot(change, other.axes[2]) + glm::dot(apart, other_change.axes[2]);
        case Joint::Kind::distance:
            return apart == glm::dvec3(0.0) ? 0.0 : glm::dot(change, glm::normalize(apart));
        default:
            return 0.0;
    }
}

template Frame frame_of(const CarriedFrame&, std::span<const glm::vec4>, bool);
template Frame frame_of(const CarriedFrame&, std::span<const glm::dvec4>, bool);

}  // namespace gelatin
