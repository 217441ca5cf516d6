#pragma once

namespace gelatin {

/// "0.1.0".
const char* version();

/// The commit from which this was built, with "-dirty" if the tree had changes; "unknown" outside a git
/// checkout.
const char* commit();

}  // namespace gelatin
