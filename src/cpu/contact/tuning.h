#pragma once

#include "model/shared_constants.h"

namespace gelatin::cpu {

/// shaders/layouts/contact_tuning.glsl.
namespace tuning = contact_tuning;

}  // namespace gelatin::cpu
