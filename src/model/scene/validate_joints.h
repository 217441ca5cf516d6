#pragma once

#include <string_view>

#include "model/scene/value_checks.h"

namespace gelatin {

/// What an attachment says of a joint: its line, rail, universal joint or distance, limits, spring and motor.
/// @param deformable name of a side that is not rigid; empty: both are rigid
void check_joint(const ValueChecks& checks, const FieldPath& field, const AttachmentDescription& attachment,
                 std::string_view deformable);

}  // namespace gelatin
