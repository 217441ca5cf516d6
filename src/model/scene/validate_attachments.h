#pragma once

#include "model/scene/value_checks.h"

namespace gelatin {

/// The part of validate() for attachments.
void check_attachments(const ValueChecks& checks, const Scene& scene);

}  // namespace gelatin
