#pragma once

#include <optional>
#include <string>

namespace gelatin {

/// What a number may be.
struct Limit {
    const char* allowed;  ///< completes "must be ..."
    bool (*holds)(double value);
};
inline constexpr Limit kAnyNumber{"a number", [](double) { return true; }};
inline constexpr Limit kPositive{"greater than 0", [](double v) { return v > 0.0; }};
inline constexpr Limit kNotNegative{"0 or more", [](double v) { return v >= 0.0; }};
inline constexpr Limit kFraction{"from 0 to 1", [](double v) { return v >= 0.0 && v <= 1.0; }};
inline constexpr Limit kHalfTurn{"from -180 to 180", [](double v) { return v >= -180.0 && v <= 180.0; }};
inline constexpr Limit kSubsteps{"\"auto\" or from 1 to 1000000",
                                 [](double v) { return v >= 1.0 && v <= 1e6; }};

/// What is wrong with `value`; empty: nothing. It must be finite, within `limit`, and 0 or of a magnitude
/// whose square the solvers' floats hold.
std::optional<std::string> problem_of(double value, const Limit& limit);

/// "corners must be three finite numbers each": what a list of such points must be.
std::string three_numbers_each(const char* points);

}  // namespace gelatin
