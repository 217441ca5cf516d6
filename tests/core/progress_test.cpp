#include "core/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "core/process.h"
#include "gelatin/error.h"

namespace gelatin {
namespace {

struct Listener : ProgressListener {
    void on_progress(double share, std::string_view what) override {
        lines.push_back(std::string(what) + " " + std::to_string(share));
    }
    bool is_cancelled() const override { return cancelled; }

    std::vector<std::string> lines;
    std::atomic<bool> cancelled = false;
};

TEST(Progress, ReachesTheInnermostListenerOfItsThread) {
    report_progress(0.5, "nobody listens");
    Listener outer, inner;
    {
        const ListenToProgress listen(outer);
        {
            const ListenToProgress also(inner);
            report_progress(0.25, "a");
        }
        report_progress(0.75, "b");
        std::thread([] { report_progress(1.0, "elsewhere"); }).join();
    }
    report_progress(1.0, "nobody listens any more");
    EXPECT_THAT(inner.lines, testing::ElementsAre("a 0.250000"));
    EXPECT_THAT(outer.lines, testing::ElementsAre("b 0.750000"));
}

TEST(Progress, CancellingEndsWhatReports) {
    check_cancelled();
    Listener listener;
    const ListenToProgress listen(listener);
    check_cancelled();
    listener.cancelled = true;
    EXPECT_THROW(check_cancelled(), Cancelled);
    EXPECT_THROW(report_progress(0.0, "a"), Cancelled);
    EXPECT_TRUE(listener.lines.empty());
}

// The program and its children are killed: else the pipe that they hold open would be read until they end.
TEST(Progress, CancellingKillsAProcess) {
    Listener listener;
    const ListenToProgress listen(listener);
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        listener.cancelled = true;
    });
    EXPECT_THROW(run_process({"sh", "-c", "sleep 600 & wait"}, {}, 600.0), Cancelled);
    later.join();
}

}  // namespace
}  // namespace gelatin
