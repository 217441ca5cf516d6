#pragma once

#include <functional>
#include <string_view>

#include "gelatin/export.h"

namespace gelatin {

enum class Severity {
    debug,
    note,     ///< what a user should know, though nothing is wrong
    warning,  ///< what is probably not intended
    error,
};

/// Receives one message, a line without an end. It must not throw.
using LogCallback = std::function<void(Severity, std::string_view message)>;

/// Sends the library's messages to `callback`, of all severities. It is called on the thread that has the
/// message, which may be any that runs or loads a simulation. Empty: to spdlog's default logger, where they
/// go until somebody calls this. Thread-safe.
GELATIN_API void set_log_callback(LogCallback callback);

}  // namespace gelatin
