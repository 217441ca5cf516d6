#include "core/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace gelatin {

void set_up_log(bool verbose) {
    auto logger =
        std::make_shared<spdlog::logger>("gelatin", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_pattern("%n: %l: %v");
    logger->set_level(verbose ? spdlog::level::info : spdlog::level::warn);
    spdlog::set_default_logger(std::move(logger));
}

void log_info(std::string_view message) {
    spdlog::info(message);
}

void log_warning(std::string_view message) {
    spdlog::warn(message);
}

void log_error(std::string_view message) {
    spdlog::error(message);
}

}  // namespace gelatin
