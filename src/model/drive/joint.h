#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <span>

namespace gelatin {

/// A point and three axes.
struct Frame {
    glm::dvec3 point{0.0};
    glm::dmat3 axes{1.0};  ///< columns: x, y, z
};

/// A frame that moves with nodes, or is fixed in space. With c = 0 for the point and 1 to 3 for the axes,
///   at[c] + sum_k weights[k][c] x_k.
struct CarriedFrame {
    std::array<std::uint32_t, 4> nodes{};
    std::array<glm::dvec4, 4> weights{};
    std::uint32_t count = 0;  ///< of nodes; 0: it is fixed
    std::array<glm::dvec3, 4> at{};
};

/// What an attachment holds besides its ties, between a frame of its object and one of the other side, which
/// were the same when it was made; of a distance each has its own point. z is the axis.
struct Joint {
    enum class Kind {
        none,
        hinge,      ///< coordinate: the angle about z [rad]
        slider,     ///< coordinate: the way along z [m]; it keeps all axes together, and the point on z
        universal,  ///< x of the object and z of the other side stay perpendicular; no coordinate
        distance,   ///< coordinate: the distance of both points [m]
    };
    static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

    Kind kind = Kind::none;
    CarriedFrame own, other;
    double lever = 1.0;                      ///< about the size of the object [m]
    glm::dvec2 limits{-kNoLimit, kNoLimit};  ///< of the coordinate
    double stiffness = 0.0, damping = 0.0;   ///< of a spring
    double rest = 0.0;                       ///< of the spring; of a distance that is kept, too
    bool is_kept = false;                    ///< the coordinate stays at `rest`

    bool has_coordinate() const { return kind != Kind::none && kind != Kind::universal; }
};

/// What a motor does in a step, in units of the joint's coordinate.
struct MotorTarget {
    bool acts = false;
    double speed = 0.0;                   ///< with a position: the greatest
    std::optional<double> position = {};  ///< to which it goes
    double force = Joint::kNoLimit;       ///< the greatest [N m] or [N]
};

/// @param values positions of all nodes [m], or, for how fast it changes, velocities [m/s]
/// @param are_positions then what is fixed counts, and axes come out orthonormal
template <class Vector>
Frame frame_of(const CarriedFrame& carried, std::span<const Vector> values, bool are_positions = true);

/// The coordinate, as far as it has one. An angle is from -pi to pi.
double coordinate(const Joint& joint, const Frame& own, const Frame& other);
/// How fast it changes. @param own_change and other_change of the frames, by velocities
double coordinate_speed(const Joint& joint, const Frame& own, const Frame& other, const Frame& own_change,
                        const Frame& other_change);

}  // namespace gelatin
