#include "model/scene/validate_cavities.h"

#include <fmt/format.h>

#include "model/scene/validate_bodies.h"

namespace gelatin {
namespace {

void check_cavity_keyframes(const ValueChecks& checks, const FieldPath& field,
                            const CavityDescription& cavity) {
    const std::vector<CavityKeyframe>& keys = cavity.keyframes;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const CavityKeyframe& key = keys[k];
        checks.check(field[k] / "time", key.time, kNotNegative);
        if (k > 0 && key.time <= keys[k - 1].time)
            checks.fail(
                field[k] / "time", text_of(key.time),
                fmt::format("must be greater than that of the keyframe before, {}", keys[k - 1].time));
        check_gas(checks, field[k], cavity, {key.pressure, key.amount});
    }
}

// There is a vacuum at most.
void check_pressure(const ValueChecks& checks, const FieldPath& field, double pressure, double ambient) {
    checks.check(field, pressure);
    if (pressure <= -ambient)
        checks.fail(field, text_of(pressure),
                    fmt::format("must be greater than {}, minus the ambient pressure", -ambient));
}

}  // namespace

void check_gas(const ValueChecks& checks, const FieldPath& field, const CavityDescription& cavity,
               const CavityGas& gas) {
    if (cavity.law == GasLaw::constant) {
        if (gas.amount) checks.fail(field / "amount", text_of(*gas.amount), "is only for law = \"sealed\"");
        if (!gas.pressure) return checks.fail(field, "", "needs a pressure");
        return check_pressure(checks, field / "pressure", *gas.pressure, cavity.ambient);
    }
    if (gas.pressure)
        checks.fail(field / "pressure", text_of(*gas.pressure), "is only for law = \"constant\"");
    if (!gas.amount) return checks.fail(field, "", "needs an amount");
    checks.check(field / "amount", gas.amount, kPositive);
}

void check_cavities(const ValueChecks& checks, const FieldPath& field,
                    const std::vector<CavityDescription>& cavities, SolverKind solver) {
    for (std::size_t c = 0; c < cavities.size(); ++c) {
        const CavityDescription& cavity = cavities[c];
        const FieldPath place = field[c];
        if (!is_implicit(solver)) checks.fail(place, "", "needs simulation.solver = \"implicit\"");
        if (cavity.region) check_region(checks, place / "region", *cavity.region);
        checks.check(place / "ambient", cavity.ambient, kPositive);
        check_pressure(checks, place / "pressure", cavity.pressure, cavity.ambient);
        checks.check(place / "amount", cavity.amount, kPositive);
        if (cavity.law == GasLaw::constant && cavity.amount != 1.0)
            checks.fail(place / "amount", text_of(cavity.amount), "is only for law = \"sealed\"");
        check_cavity_keyframes(checks, place / "keyframes", cavity);
    }
    check_optional_names(checks, field, "cavity", cavities);
}

}  // namespace gelatin
