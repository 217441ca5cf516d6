#pragma once

#include <spdlog/spdlog.h>

namespace gelatin {

/// Sends spdlog's default logger to stderr as "gelatin: warning: ...", one line for each message, warnings
/// and above; with `verbose` also information. The library itself only logs; programs call this once.
void set_up_log(bool verbose);

}  // namespace gelatin
