#include "core/log.h"

#include <spdlog/sinks/stdout_sinks.h>

namespace gelatin {

void set_up_log(bool verbose) {
    auto logger =
        std::make_shared<spdlog::logger>("gelatin", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_pattern("%n: %l: %v");
    logger->set_level(verbose ? spdlog::level::info : spdlog::level::warn);
    spdlog::set_default_logger(std::move(logger));
}

}  // namespace gelatin
