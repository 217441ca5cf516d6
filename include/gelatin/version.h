#pragma once

#include "gelatin/export.h"

/// Of these headers; version() is that of the library that runs. Semantic versions: before 1.0 a new minor
/// version may change the interface, after it a new major one.
#define GELATIN_VERSION_MAJOR 0
#define GELATIN_VERSION_MINOR 1
#define GELATIN_VERSION_PATCH 0

namespace gelatin {

/// "0.1.0".
GELATIN_API const char* version();

/// The commit from which this was built, with "-dirty" if the tree had changes; "unknown" outside a git
/// checkout.
GELATIN_API const char* commit();

}  // namespace gelatin
