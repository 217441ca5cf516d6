#include "core/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <limits>
#include <thread>

#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin {
namespace {

using testing::HasSubstr;

constexpr double kPlenty = 60.0;  // [s]

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

ProcessResult run_shell(const std::string& script, double time_limit = kPlenty) {
    return run_process({"sh", "-c", script}, "/", time_limit);
}

TEST(RunProcess, PassesOnOutputAndExitCode) {
    const ProcessResult result = run_shell("echo out; echo error >&2; exit 7");
    EXPECT_EQ(result.exit_code, 7);
    EXPECT_EQ(result.signal, 0);
    EXPECT_FALSE(result.timed_out);
    EXPECT_FALSE(result.succeeded());
    EXPECT_EQ(result.output, "out\nerror\n");
}

TEST(RunProcess, TakesArgumentsAsTheyAre) {
    const ProcessResult result = run_process({"printf", "%s|", "a b", "$HOME", "*"}, "/", kPlenty);
    EXPECT_TRUE(result.succeeded());
    EXPECT_EQ(result.output, "a b|$HOME|*|");
}

TEST(RunProcess, WorksInTheFolder) {
    const TemporaryFolder folder;
    EXPECT_TRUE(run_process({"touch", "made"}, folder.path(), kPlenty).succeeded());
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "made"));
}

TEST(RunProcess, HasAnEmptyInputAndItsOwnGroup) {
    EXPECT_EQ(run_process({"cat"}, "/", kPlenty).output, "");
    const ProcessResult result =
        run_shell("echo $$; ps -o pgid= -p $$ 2>/dev/null || cut -d' ' -f5 /proc/$$/stat");
    std::istringstream words(result.output);
    long pid = 0, group = 1;
    words >> pid >> group;
    EXPECT_EQ(pid, group);
}

TEST(RunProcess, TellsOfASignal) {
    const ProcessResult result = run_shell("kill -ABRT $$");
    EXPECT_EQ(result.signal, SIGABRT);
    EXPECT_FALSE(result.succeeded());
    EXPECT_FALSE(result.timed_out);
}

TEST(RunProcess, KeepsTheLast64KiB) {
    const ProcessResult result = run_shell("i=0; while [ $i -lt 20000 ]; do echo line $i; i=$((i+1)); done");
    EXPECT_TRUE(result.succeeded());
    EXPECT_EQ(result.output.size(), 64u * 1024u);
    EXPECT_THAT(result.output, testing::EndsWith("line 19999\n"));
}

TEST(RunProcess, KillsTheWholeGroupAtTheTimeLimit) {
    const TemporaryFolder folder;
    const auto start = std::chrono::steady_clock::now();
    const ProcessResult result =
        run_process({"sh", "-c", "(sleep 1; touch survived) & echo before; sleep 100"}, folder.path(), 0.2);
    EXPECT_LT(seconds_since(start), 50.0);
    EXPECT_TRUE(result.timed_out);
    EXPECT_FALSE(result.succeeded());
    EXPECT_THAT(result.output, HasSubstr("before"));
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "survived"));
}

TEST(RunProcess, LimitsAProgramThatWritesWithoutEnd) {
    EXPECT_TRUE(run_process({"yes"}, "/", 0.2).timed_out);
}

TEST(RunProcess, LimitsAProgramThatClosesItsOutput) {
    EXPECT_TRUE(run_process({"sh", "-c", "exec >&- 2>&-; sleep 100"}, "/", 0.2).timed_out);
}

TEST(RunProcess, DoesNotWaitForAGrandchildThatKeepsTheOutput) {
    const auto start = std::chrono::steady_clock::now();
    const ProcessResult result = run_shell("sleep 30 & echo done");
    EXPECT_TRUE(result.succeeded());
    EXPECT_EQ(result.output, "done\n");
    EXPECT_LT(seconds_since(start), 25.0);
}

TEST(RunProcess, RefusesAProgramThatIsNotThere) {
    try {
        run_process({"gelatin-no-such-program"}, "/", kPlenty);
        FAIL() << "did not throw";
    } catch (const SystemError& error) {
        EXPECT_THAT(error.what(), HasSubstr("gelatin-no-such-program"));
        EXPECT_THAT(error.what(), HasSubstr("No such file"));
    }
    EXPECT_THROW(FedProcess({"gelatin-no-such-program"}), SystemError);
}

TEST(FedProcess, TakesItsInputAndSaysHowItEnded) {
    FedProcess process({"sh", "-c", "wc -c; echo said >&2; exit 3"});
    const std::string data(1 << 20, 'x');
    EXPECT_TRUE(process.write(data.data(), data.size()));
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.output, HasSubstr("1048576"));
    EXPECT_THAT(result.output, HasSubstr("said"));
}

// Without MSG_NOSIGNAL this ends the test program by SIGPIPE.
TEST(FedProcess, ReportsAProgramThatEndsEarly) {
    FedProcess process({"sh", "-c", "echo no room >&2; exit 1"});
    const std::string data(1 << 16, 'x');
    bool accepted = true;
    for (int i = 0; i < 1000 && accepted; ++i) accepted = process.write(data.data(), data.size());
    EXPECT_FALSE(accepted);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.output, HasSubstr("no room"));
}

TEST(FedProcess, KeepsTheLast64KiBOfTheLog) {
    FedProcess process({"sh", "-c", "i=0; while [ $i -lt 20000 ]; do echo line $i; i=$((i+1)); done"});
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.output.size(), 64u * 1024u);
    EXPECT_THAT(result.output, testing::EndsWith("line 19999\n"));
}

TEST(FedProcess, IsKilledWhenAbandoned) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "survived";
    { FedProcess process({"sh", "-c", "trap '' PIPE; sleep 1; touch " + file.string()}); }
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace gelatin
