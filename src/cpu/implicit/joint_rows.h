#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "cpu/contact/tuning.h"
#include "cpu/implicit/contact_row.h"
#include "cpu/nodes.h"
#include "model/drive/attachment.h"

namespace gelatin::cpu {

/// What a motor did in the last step, in units of its row.
struct MotorMemory {
    double held = 0.0;          ///< along the axis, reversed [N]
    double speed = 0.0;         ///< [m/s]
    double acceleration = 0.0;  ///< when its force was too small last; 0: it never was [m/s^2]
};

/// The rows of a joint in a step (docs/joints.md#rows). Directions and angles change within it: rows
/// are linear about where frames are expected at its end.
template <class Real>
class JointRows {
public:
    /// @param positions when the step begins [m] @param expected displacements [m], shape [nodes]
    JointRows(const Attachment& attachment, std::span<const Vec4<Real>> positions,
              std::span<const Vec3<Real>> expected)
        : joint_(attachment.joint) {
        own_ = frame_of(joint_.own, positions);
        other_ = frame_of(joint_.other, positions);
        const auto at_end = [&](const CarriedFrame& carried) {
            std::array<Vec4<Real>, 4> ends;
            CarriedFrame moved = carried;
            for (std::uint32_t k = 0; k < carried.count; ++k) {
                const std::uint32_t n = carried.nodes[k];
                ends[k] = positions[n] + Vec4<Real>(expected[n], 0);
                moved.nodes[k] = k;
            }
            return frame_of(moved, std::span<const Vec4<Real>>(ends));
        };
        own_end_ = at_end(joint_.own);
        other_end_ = at_end(joint_.other);
        start_ = coordinate(joint_, own_, other_);
        end_ = coordinate(joint_, own_end_, other_end_);
        find_coordinate();
    }

    /// Adds all.
    /// @param blank with what all rows of the attachment have
    /// @param stiffness_of a row by the nodes it has: of what does not yield; 0: nothing of it is free
    void add(const MotorTarget& motor, const MotorMemory& memory, double step, const ContactRow<Real>& blank,
             const std::function<Real(const ContactRow<Real>&)>& stiffness_of,
             std::vector<ContactRow<Real>>& rows) const {
        constexpr double kAny = std::numeric_limits<Real>::max();
        ContactRow<Real> along = row_of(blank, sides_);
        along.is_along = true;
        const auto rigid = static_cast<double>(stiffness_of(along));
        if (!(rigid > 0.0)) return;
        const double now = offset_ + glm::dot(axis_, apart(sides_));  // without a displacement
        // Holds the coordinate at a value, with a force in these bounds. @param sign of it: -1 reverses them
        const auto hold = [&](double stiffness, double at, double least, double most, double sign = 1.0) {
            ContactRow<Real>& row = rows.emplace_back(along);
            row.normal *= static_cast<Real>(sign);
            row.stiffness = static_cast<Real>(stiffness);
            row.hold = static_cast<Real>(sign * stiffness * (now - at)) * row.normal;
            row.least = static_cast<Real>(least);
            row.limit = static_cast<Real>(most);
        };
        const auto drive = [&](double stiffness, double at, double most) {
            hold(stiffness, at, -most, most);
            rows.back().drives = true;
        };
        if (joint_.kind == Joint::Kind::universal) return hold(rigid, 0.0, -kAny, kAny);
        const double unit = scale();
        if (joint_.is_kept) hold(rigid, unit * joint_.rest, -kAny, kAny);
        if (joint_.limits.x > -Joint::kNoLimit) hold(rigid, unit * joint_.limits.x, 0.0, kAny, -1.0);
        if (joint_.limits.y < Joint::kNoLimit) hold(rigid, unit * joint_.limits.y, 0.0, kAny);
        // What is stiffer than the joint is as stiff as it.
        const auto soft = [&](double stiffness) { return std::min(stiffness / (unit * unit), rigid); };
        if (joint_.stiffness > 0.0) hold(soft(joint_.stiffness), unit * joint_.rest, -kAny, kAny);
        if (joint_.damping > 0.0) drive(soft(joint_.damping / step), unit * start_, kAny);
        if (motor.acts) {
            double speed = motor.speed;
            if (motor.position) {
                // So that half of its force can stop it there.
                const double left = *motor.position - start_;
                if (memory.acceleration > 0.0)
                    speed = std::min(speed, std::sqrt(memory.acceleration / unit * std::abs(left)));
                speed = std::clamp(left / std::max(step, tuning::kFrame), -speed, speed);
            }
            // No farther than its limits, which are no stiffer than a motor of any force.
            speed = std::min(speed, std::max(joint_.limits.y - start_, 0.0) / step);
            speed = std::max(speed, std::min(joint_.limits.x - start_, 0.0) / step);
            // What rigid bodies' rows are stiff by is for a part of 1/240 s. This one keeps no energy, and
            // goes by the part: else it would be too soft in short ones.
            const double part = tuning::kFrame / tuning::kPartsOfMoving / step;
            drive(rigid * part * part, unit * start_, std::min(motor.force / unit, kAny));
            rows.back().hold += static_cast<Real>(memory.held) * rows.back().normal;
            rows.back().target = static_cast<Real>(unit * speed * step) * rows.back().normal;
            rows.back().is_motor = true;
        }
        if (joint_.kind != Joint::Kind::slider) return;
        const double r = joint_.lever;  // across the axis, at points that keep all rotations
        for (const glm::dvec3& p :
             {glm::dvec3(0.0, 0.0, r), glm::dvec3(0.0, 0.0, -r), glm::dvec3(r, 0.0, 0.0)}) {
            const Sides sides{{1.0, p}, {1.0, p.x, p.y, p.z + end_}};
            ContactRow<Real> row = row_of(blank, sides);
            row.stiffness = stiffness_of(row);
            const glm::dvec3 off = apart(sides);
            row.hold = row.stiffness * Vec3<Real>(off - glm::dot(axis_, off) * axis_);
            rows.push_back(row);
        }
    }
    /// Along which the coordinate grows.
    Vec3<Real> axis() const { return Vec3<Real>(axis_); }
    /// What the effort is for a force along it [m] or 1.
    double scale() const { return joint_.kind == Joint::Kind::hinge ? joint_.lever : 1.0; }

private:
    // Of what a row ties, in the coordinates of both frames: 1 or 0 for the point, and of its axes.
    struct Sides {
        glm::dvec4 own, other;
    };
    ContactRow<Real> row_of(const ContactRow<Real>& blank, const Sides& sides) const {
        ContactRow<Real> row = blank;
        row.is_couple = sides.own.x == 0.0;
        row.normal = axis();
        const auto add = [&](const CarriedFrame& carried, const glm::dvec4& place, double sign) {
            for (std::uint32_t k = 0; k < carried.count; ++k) {
                row.nodes[row.count] = carried.nodes[k];
                row.weights[row.count++] = static_cast<Real>(sign * glm::dot(carried.weights[k], place));
            }
        };
        add(joint_.own, sides.own, 1.0);
        add(joint_.other, sides.other, -1.0);
        return row;
    }
    // When the step begins [m].
    glm::dvec3 apart(const Sides& sides) const {
        const auto at = [](const Frame& frame, const glm::dvec4& place) {
            return place.x * frame.point + frame.axes * glm::dvec3(place.y, place.z, place.w);
        };
        return at(own_, sides.own) - at(other_, sides.other);
    }

    // What the row of the coordinate ties. At the expected end both sides of it are together, but for a
    // distance.
    void find_coordinate() {
        const double lever = joint_.lever;
        switch (joint_.kind) {
            case Joint::Kind::hinge:
                end_ = nearest_angle(end_, start_);
                sides_ = {{0.0, lever, 0.0, 0.0}, {0.0, lever * std::cos(end_), lever * std::sin(end_), 0.0}};
                axis_ = glm::normalize(glm::cross(other_end_.axes[2], own_end_.axes[0]));
                offset_ = lever * end_;
                break;
            case Joint::Kind::slider:
                sides_ = {{1.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, end_}};
                axis_ = other_end_.axes[2];
                offset_ = end_;
                break;
            case Joint::Kind::universal: {
                const glm::dvec3 x = lever * own_end_.axes[0] * other_end_.axes;
                sides_ = {{0.0, lever, 0.0, 0.0}, {0.0, x}};
                axis_ = other_end_.axes[2];
                offset_ = x.z;
                break;
            }
            default:
                sides_ = {{1.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
                if (const glm::dvec3 apart = own_end_.point - other_end_.point; apart != glm::dvec3(0.0))
                    axis_ = glm::normalize(apart);
                break;
        }
    }

    // The same angle, no farther than half a turn from another one.
    static double nearest_angle(double angle, double other) {
        return other + std::remainder(angle - other, 2.0 * std::numbers::pi);
    }

    const Joint& joint_;
    Frame own_, other_, own_end_, other_end_;
    double start_ = 0.0, end_ = 0.0;  // the coordinate
    // Along n the row of the coordinate has scale() times it, but for an offset.
    Sides sides_{};
    glm::dvec3 axis_{0.0};
    double offset_ = 0.0;
};

}  // namespace gelatin::cpu
