#include "model/scene/validate_joints.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

namespace gelatin {
namespace {

// What files and programs round away, of a distance at the start.
constexpr double kDistanceRounding = 1e-6;

// Of a joint that has one: [degrees] of a line, else [m].
struct JointCoordinate {
    double start;
    Limit range;  // of limits, of where a spring rests, and of where a motor goes
};

std::optional<JointCoordinate> coordinate_of(const AttachmentDescription& attachment) {
    if (std::holds_alternative<AttachedLine>(attachment.where)) return JointCoordinate{0.0, kHalfTurn};
    if (std::holds_alternative<AttachedRail>(attachment.where)) return JointCoordinate{0.0, kAnyNumber};
    if (const auto* distance = std::get_if<AttachedDistance>(&attachment.where))
        return JointCoordinate{glm::distance(distance->from, distance->to), kNotNegative};
    return {};
}

std::string text_of_points(const glm::dvec3& from, const glm::dvec3& to) {
    return fmt::format("[{}, {}]", text_of(from), text_of(to));
}

void check_two_points(const ValueChecks& checks, const FieldPath& field, const glm::dvec3& from,
                      const glm::dvec3& to) {
    const auto fail = [&](const std::string& problem) {
        checks.fail(field, text_of_points(from, to), problem);
    };
    for (int axis = 0; axis < 3; ++axis) {
        if (problem_of(from[axis], kAnyNumber) || problem_of(to[axis], kAnyNumber))
            fail(three_numbers_each("points"));
    }
    if (problem_of(glm::distance(from, to), kPositive)) fail("must be two different points");
}

void check_axis(const ValueChecks& checks, const FieldPath& field, const glm::dvec3& axis) {
    checks.check(field, axis);
    if (problem_of(glm::length(axis), kPositive))
        checks.fail(field, text_of(axis), "must not be zero: a direction");
}

void check_universal(const ValueChecks& checks, const FieldPath& field, const AttachedUniversal& universal) {
    checks.check(field / "point", universal.at);
    check_axis(checks, field / "own", universal.own);
    check_axis(checks, field / "of_other", universal.of_other);
    const double cosine = glm::dot(glm::normalize(universal.own), glm::normalize(universal.of_other));
    const double angle = glm::degrees(std::acos(glm::clamp(cosine, -1.0, 1.0)));
    if (!(std::abs(angle - 90.0) <= 1.0))
        checks.fail(field / "own", text_of(universal.own),
                    fmt::format("must be perpendicular to of_other within 1 degree, and is at {:.4g} degrees",
                                angle));
}

void check_limits(const ValueChecks& checks, const FieldPath& field, const glm::dvec2& limits,
                  const JointCoordinate& coordinate) {
    for (std::size_t k = 0; k < 2; ++k) checks.check(field[k], limits[static_cast<int>(k)], coordinate.range);
    if (limits.x > limits.y) checks.fail(field, text_of(limits), "the first must not be above the second");
    const double start = coordinate.start, tolerance = kDistanceRounding * start;
    if (limits.x > start + tolerance || limits.y < start - tolerance)
        checks.fail(field, text_of(limits),
                    fmt::format("must include {:.6g}, where the joint is at the start", start));
}

void check_joint_spring(const ValueChecks& checks, const FieldPath& field, const JointSpring& spring,
                        const Limit& range) {
    checks.check(field / "stiffness", spring.stiffness, kNotNegative);
    checks.check(field / "damping", spring.damping, kNotNegative);
    checks.check(field / "rest", spring.rest, range);
    if (spring.stiffness == 0.0 && spring.damping == 0.0)
        checks.fail(field, "", "needs a stiffness or a damping above 0");
}

// What is given from a time on, and then what the motor does, `now`.
void check_stage(const ValueChecks& checks, const FieldPath& field, const MotorKeyframe& given,
                 const Limit& range, MotorKeyframe& now) {
    checks.check(field / "speed", given.speed);
    checks.check(field / "position", given.position, range);
    checks.check(field / "force", given.force, kNotNegative);
    if (given.speed) now.speed = given.speed;
    if (given.position) now.position = given.position;
    if (!now.position || !now.speed || *now.speed > 0.0) return;
    if (given.speed) {
        checks.fail(field / "speed", text_of(*given.speed),
                    "must be greater than 0 where there is a position");
    } else {
        checks.fail(field / "position", text_of(*now.position),
                    fmt::format("needs a speed greater than 0, and it is {}", *now.speed));
    }
}

void check_motor(const ValueChecks& checks, const FieldPath& field, const JointMotor& motor,
                 const Limit& range) {
    if (!motor.speed && !motor.position) checks.fail(field, "", "needs a speed or a position");
    MotorKeyframe now;
    check_stage(checks, field, {0.0, motor.speed, motor.position, motor.force}, range, now);
    const FieldPath keyframes = field / "keyframes";
    for (std::size_t k = 0; k < motor.keyframes.size(); ++k) {
        const MotorKeyframe& key = motor.keyframes[k];
        checks.check(keyframes[k] / "time", key.time, kNotNegative);
        if (k > 0 && key.time <= motor.keyframes[k - 1].time)
            checks.fail(keyframes[k] / "time", text_of(key.time),
                        fmt::format("must be greater than that of the keyframe before, {}",
                                    motor.keyframes[k - 1].time));
        if (!key.speed && !key.position && !key.force)
            checks.fail(keyframes[k], "", "needs a speed, a position or a force");
        check_stage(checks, keyframes[k], key, range, now);
    }
}

}  // namespace

void check_joint(const ValueChecks& checks, const FieldPath& field, const AttachmentDescription& attachment,
                 std::string_view deformable) {
    const auto require_rigid = [&](const char* key, const std::string& value, const char* where) {
        if (!deformable.empty())
            checks.fail(field / key, value,
                        fmt::format("{}both sides must be rigid, and '{}' is deformable", where, deformable));
    };
    const auto* line = std::get_if<AttachedLine>(&attachment.where);
    if (line != nullptr) check_two_points(checks, field / "line", line->from, line->to);
    if (const auto* rail = std::get_if<AttachedRail>(&attachment.where)) {
        check_two_points(checks, field / "rail", rail->from, rail->to);
        require_rigid("rail", text_of_points(rail->from, rail->to), "");
    }
    if (const auto* universal = std::get_if<AttachedUniversal>(&attachment.where)) {
        check_universal(checks, field / "universal", *universal);
        require_rigid("universal", "", "");
    }
    if (const auto* distance = std::get_if<AttachedDistance>(&attachment.where))
        check_two_points(checks, field / "distance", distance->from, distance->to);

    const std::optional<JointCoordinate> coordinate = coordinate_of(attachment);
    const auto has_coordinate = [&](const char* key, const std::string& value) {
        if (!coordinate) checks.fail(field / key, value, "needs a line, a rail or a distance");
        if (line != nullptr) require_rigid(key, value, "at a line ");
        return coordinate.has_value();
    };
    if (attachment.limits && has_coordinate("limits", text_of(*attachment.limits)))
        check_limits(checks, field / "limits", *attachment.limits, *coordinate);
    if (attachment.spring && has_coordinate("spring", ""))
        check_joint_spring(checks, field / "spring", *attachment.spring, coordinate->range);
    if (attachment.motor && has_coordinate("motor", ""))
        check_motor(checks, field / "motor", *attachment.motor, coordinate->range);
}

}  // namespace gelatin
