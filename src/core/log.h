#pragma once

#include <string_view>

namespace gelatin {

/// Sends spdlog's default logger to stderr as "gelatin: warning: ..." or "gelatin: note: ...", one line for
/// each message; with `verbose` also those for debugging. The library itself only logs; programs call this
/// once.
void set_up_log(bool verbose);

/// Messages to spdlog's default logger. Its headers, which take long to compile, are included by log.cpp
/// alone.
void log_debug(std::string_view message);
void log_note(std::string_view message);  ///< what a user should know, though nothing is wrong; spdlog's info
void log_warning(std::string_view message);
void log_error(std::string_view message);

}  // namespace gelatin
