#pragma once

#include <string>
#include <vector>

namespace gelatin::gl {

/// Collects the driver's debug messages of the current context in a list (and in the log): errors, undefined
/// behaviour, deprecations, portability; without performance notes and notifications.
void enable_debug_output();

/// The messages since the last call.
std::vector<std::string> take_debug_messages();

/// @throws GlError naming `what` if glGetError reports an error.
void check_errors(const char* what);

}  // namespace gelatin::gl
