#pragma once

namespace gelatin {

/// "0.1.0".
const char* version();

/// The commit this was built from, with "-dirty" where the tree had changes; "unknown" outside a git
/// checkout.
const char* commit();

}  // namespace gelatin
