#pragma once

#include <string_view>

namespace gelatin {

/// The least important messages that are shown.
enum class LogLevel { warnings, notes, debugging };

/// Sends spdlog's default logger to stderr as "gelatin: warning: ..." or "gelatin: note: ...", one line for
/// each message. The library itself only logs; programs call this.
void set_up_log(LogLevel level);

/// Messages to spdlog's default logger. Its headers, which take long to compile, are included by log.cpp
/// alone.
void log_debug(std::string_view message);
void log_note(std::string_view message);  ///< what a user should know, though nothing is wrong; spdlog's info
void log_warning(std::string_view message);
void log_error(std::string_view message);

}  // namespace gelatin
