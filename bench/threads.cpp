#include "bench/threads.h"

#include <tbb/info.h>

#include "core/counted.h"

namespace gelatin {

std::vector<int> measured_thread_counts() {
    const int all = tbb::info::default_concurrency();
    return all > 1 ? std::vector<int>{1, all} : std::vector<int>{1};
}

std::string describe_cpu(int threads) {
    return "CPU, " + counted(threads, "thread");
}

}  // namespace gelatin
