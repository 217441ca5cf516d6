#pragma once

#include <string>
#include <vector>

namespace gelatin::gl {

/// Routes the driver's debug messages of the current context to a list (and to the log): errors, undefined
/// behaviour, deprecations, portability; performance notes and notifications are left out.
void enable_debug_output();

/// The messages since the last call.
std::vector<std::string> take_debug_messages();

/// @throws GlError naming `what` if glGetError has something to say.
void check_errors(const char* what);

}  // namespace gelatin::gl
