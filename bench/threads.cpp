#include "bench/threads.h"

#include <fmt/core.h>
#include <tbb/info.h>

namespace gelatin {

std::vector<int> measured_thread_counts() {
    const int all = tbb::info::default_concurrency();
    return all > 1 ? std::vector<int>{1, all} : std::vector<int>{1};
}

std::string describe_cpu(int threads) {
    return fmt::format("CPU, {} thread{}", threads, threads == 1 ? "" : "s");
}

}  // namespace gelatin
