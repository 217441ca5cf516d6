#pragma once

#include <cstdint>

/// The numbers that C++ and GLSL share: files of shaders/layouts/ compiled as C++. Within the namespaces they
/// are what shaders have; code that uses them gives them its own names.
namespace gelatin {

using uint = std::uint32_t;

/// Chosen numbers of contact and the implicit step.
namespace contact_tuning {
#define REAL inline constexpr double
#define COUNT inline constexpr uint
#include "layouts/contact_tuning.glsl"
#undef REAL
#undef COUNT
}  // namespace contact_tuning

/// Arguments of the indirect dispatches of collision.
namespace dispatch_slots {
#include "layouts/dispatch_slots.glsl"
}  // namespace dispatch_slots

/// What the end of a part of an implicit step sums.
namespace end_sums {
#include "layouts/end_sums.glsl"
}  // namespace end_sums

/// How packed arrays and bit fields are laid out.
namespace packing {
#include "layouts/packing.glsl"
}  // namespace packing

/// Stages of the search for pairs of surfaces that are near each other.
namespace pair_stages {
#include "layouts/pair_stages.glsl"
}  // namespace pair_stages

/// What decides in the geometric predicates.
namespace predicates {
#include "layouts/predicates.glsl"
}  // namespace predicates

/// What decides between cases of forces, shapes and contacts.
namespace thresholds {
#include "layouts/thresholds.glsl"
}  // namespace thresholds

/// Arguments of the indirect dispatches of a try to make a part of a step.
namespace try_dispatches {
#include "layouts/tries.glsl"
}  // namespace try_dispatches

}  // namespace gelatin
