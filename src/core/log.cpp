#include "core/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <utility>

namespace gelatin {
namespace {

/// The name of a message's level, where information is a note.
class LevelName : public spdlog::custom_flag_formatter {
public:
    void format(const spdlog::details::log_msg& message, const std::tm&,
                spdlog::memory_buf_t& text) override {
        const auto name = message.level == spdlog::level::info ? spdlog::string_view_t("note")
                                                               : spdlog::level::to_string_view(message.level);
        text.append(name.data(), name.data() + name.size());
    }
    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<LevelName>(); }
};

}  // namespace

void set_up_log(LogLevel level) {
    auto logger =
        std::make_shared<spdlog::logger>("gelatin", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<LevelName>('*').set_pattern("%n: %*: %v");
    logger->set_formatter(std::move(formatter));
    logger->set_level(level == LogLevel::debugging ? spdlog::level::debug
                      : level == LogLevel::notes   ? spdlog::level::info
                                                   : spdlog::level::warn);
    spdlog::set_default_logger(std::move(logger));
}

void log_debug(std::string_view message) {
    spdlog::debug(message);
}

void log_note(std::string_view message) {
    spdlog::info(message);
}

void log_warning(std::string_view message) {
    spdlog::warn(message);
}

void log_error(std::string_view message) {
    spdlog::error(message);
}

}  // namespace gelatin
