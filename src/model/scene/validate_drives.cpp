#include <fmt/format.h>

#include "gelatin/error.h"
#include "model/scene/validate_animation.h"
#include "model/scene/validate_bodies.h"

namespace gelatin {
namespace {

void check_box(const ValueChecks& checks, const FieldPath& field, const BoxRegion& box) {
    const auto fail = [&](const std::string& problem) {
        checks.fail(field, fmt::format("[{}, {}]", text_of(box.min), text_of(box.max)), problem);
    };
    for (int axis = 0; axis < 3; ++axis) {
        if (problem_of(box.min[axis], kAnyNumber) || problem_of(box.max[axis], kAnyNumber))
            fail(three_numbers_each("corners"));
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (box.min[axis] > box.max[axis]) {
            fail(fmt::format("the first corner must be the lower one: {} is above {} along {}", box.min[axis],
                             box.max[axis], "xyz"[axis]));
        }
    }
}

}  // namespace

void check_region(const ValueChecks& checks, const FieldPath& field, const Region& region) {
    if (const auto* box = std::get_if<BoxRegion>(&region)) check_box(checks, field / "box", *box);
    if (const auto* sphere = std::get_if<SphereRegion>(&region)) {
        checks.check(field / "sphere", sphere->center);
        checks.check(field / "radius", sphere->radius, kPositive);
    }
    if (const auto* half_space = std::get_if<HalfSpaceRegion>(&region)) {
        checks.check_direction(field / "plane", half_space->normal);
        checks.check(field / "offset", half_space->offset);
    }
}

void check_region(const Region& region) {
    const ReportProblem report = [](const FieldPath& field, const std::string& value,
                                    const std::string& problem) {
        throw InvalidInput({{}, 0, describe(field, {}), value, problem});
    };
    check_region(ValueChecks(report), FieldPath("region"), region);
}

void check_keyframes(const ValueChecks& checks, const FieldPath& field, const std::vector<Keyframe>& keys) {
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const Keyframe& key = keys[k];
        checks.check(field[k] / "time", key.time, kNotNegative);
        checks.check(field[k] / "move", key.move);
        checks.check(field[k] / "turn", key.turn);
        checks.check(field[k] / "scale", key.scale, kPositive);
        const bool rests = key.move == glm::dvec3(0.0) && key.turn == glm::dvec3(0.0) && key.scale == 1.0;
        if (k == 0 && !rests) {
            checks.fail(field[k], "",
                        "the first keyframe is where the body starts: it must not move, rotate or scale it");
        }
        if (k > 0 && key.time <= keys[k - 1].time) {
            checks.fail(
                field[k] / "time", text_of(key.time),
                fmt::format("must be greater than that of the keyframe before, {}", keys[k - 1].time));
        }
    }
}

void check_when_blocked(const ValueChecks& checks, const FieldPath& field, WhenBlocked when_blocked,
                        bool moves, bool has_contact) {
    if (when_blocked != WhenBlocked::stops) return;
    if (!moves) checks.fail(field, text_of("stops"), "needs keyframes or an animation");
    if (!has_contact) checks.fail(field, text_of("stops"), kNeedsContact);
}

void check_handle(const ValueChecks& checks, const FieldPath& field, const HandleDescription& handle,
                  bool has_contact) {
    if (handle.skeleton) {
        check_skeleton(checks, field / "skeleton", *handle.skeleton);
    } else {
        check_region(checks, field / "region", handle.region);
    }
    checks.check(field / "pivot", handle.pivot);
    checks.check(field / "release", handle.release, kPositive);
    check_keyframes(checks, field / "keyframes", handle.keyframes);
    check_when_blocked(checks, field / "when_blocked", handle.when_blocked,
                       !handle.keyframes.empty() || handle.skeleton, has_contact);
    checks.check(field / "drag" / "move", handle.drag.move);
    checks.check(field / "drag" / "turn", handle.drag.turn);
}

void check_load(const ValueChecks& checks, const FieldPath& field, const LoadDescription& load) {
    check_region(checks, field / "region", load.region);
    if (const auto* force = std::get_if<ForceLoad>(&load.kind)) checks.check(field / "force", force->sum);
    if (const auto* traction = std::get_if<TractionLoad>(&load.kind))
        checks.check(field / "traction", traction->stress);
    if (const auto* pressure = std::get_if<PressureLoad>(&load.kind))
        checks.check(field / "pressure", pressure->pressure);
    checks.check(field / "from", load.from, kNotNegative);
    checks.check(field / "until", load.until, kPositive);
    const double from = load.from.value_or(0.0);
    if (load.until && *load.until <= from)
        checks.fail(field / "until", text_of(*load.until),
                    fmt::format("must be greater than from, {}", from));
}

}  // namespace gelatin
