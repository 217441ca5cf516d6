#pragma once

#include "model/scene/value_checks.h"

namespace gelatin {

/// @param shape whose vertices it moves
void check_animation(const ValueChecks& checks, const FieldPath& field, const AnimationDescription& animation,
                     const Shape& shape);
void check_skeleton(const ValueChecks& checks, const FieldPath& field, const SkeletonDescription& skeleton);

}  // namespace gelatin
