#include "messages.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "gelatin/log.h"

namespace gelatin::python {
namespace {

namespace nb = nanobind;

struct Message {
    Severity severity;
    std::string text;
};

std::mutex mutex;
std::vector<Message> waiting;

// As of the module `logging`.
int level_of(Severity severity) {
    switch (severity) {
        case Severity::debug:
            return 10;
        case Severity::note:
            return 20;
        case Severity::warning:
            return 30;
        case Severity::error:
            break;
    }
    return 40;
}

}  // namespace

void collect_messages() {
    set_log_callback([](Severity severity, std::string_view text) {
        const std::lock_guard<std::mutex> lock(mutex);
        waiting.push_back({severity, std::string(text)});
    });
}

void tell_messages() noexcept {
    std::vector<Message> messages;
    {
        const std::lock_guard<std::mutex> lock(mutex);
        messages.swap(waiting);
    }
    if (messages.empty()) return;
    try {
        const nb::object logger = nb::module_::import_("logging").attr("getLogger")("gelatin");
        // As an argument, so that a percent sign in it is no format.
        for (const Message& message : messages)
            logger.attr("log")(level_of(message.severity), "%s", message.text);
    } catch (nb::python_error& error) {
        error.discard_as_unraisable("gelatin's messages");
    }
}

}  // namespace gelatin::python
