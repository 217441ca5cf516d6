#pragma once

#include <string_view>

namespace gelatin {

/// Sends spdlog's default logger to stderr as "gelatin: warning: ...", one line for each message, warnings
/// and above; with `verbose` also information. The library itself only logs; programs call this once.
void set_up_log(bool verbose);

/// Messages to spdlog's default logger. Its headers, which take long to compile, are included by log.cpp
/// alone.
void log_info(std::string_view message);
void log_warning(std::string_view message);
void log_error(std::string_view message);

}  // namespace gelatin
