#include "core/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gelatin/log.h"

namespace gelatin {
namespace {

TEST(Log, ACallbackGetsEachMessageWithItsSeverity) {
    std::vector<std::string> lines;
    set_log_callback([&](Severity severity, std::string_view message) {
        lines.push_back(std::to_string(static_cast<int>(severity)) + std::string(message));
    });
    log_debug("a");
    log_note("b");
    log_warning("c");
    log_error("d");
    set_log_callback({});
    log_debug("nobody hears this");
    EXPECT_THAT(lines, testing::ElementsAre("0a", "1b", "2c", "3d"));
}

TEST(Log, ACallbackMayEndItself) {
    int calls = 0;
    set_log_callback([&](Severity, std::string_view) {
        ++calls;
        set_log_callback({});
    });
    log_debug("a");
    log_debug("b");
    EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace gelatin
