#include "core/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <mutex>
#include <utility>

#include "gelatin/log.h"

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

std::mutex callback_mutex;
std::shared_ptr<const LogCallback> current_callback;

// False: there is none. It may set another one.
bool call_back(Severity severity, std::string_view message) {
    std::shared_ptr<const LogCallback> callback;
    {
        const std::lock_guard lock(callback_mutex);
        callback = current_callback;
    }
    if (callback) (*callback)(severity, message);
    return callback != nullptr;
}

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

void set_log_callback(LogCallback callback) {
    const auto next = callback ? std::make_shared<const LogCallback>(std::move(callback)) : nullptr;
    const std::lock_guard lock(callback_mutex);
    current_callback = next;
}

void log_debug(std::string_view message) {
    if (!call_back(Severity::debug, message)) spdlog::debug(message);
}

void log_note(std::string_view message) {
    if (!call_back(Severity::note, message)) spdlog::info(message);
}

void log_warning(std::string_view message) {
    if (!call_back(Severity::warning, message)) spdlog::warn(message);
}

void log_error(std::string_view message) {
    if (!call_back(Severity::error, message)) spdlog::error(message);
}

}  // namespace gelatin
