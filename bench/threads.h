#pragma once

#include <tbb/global_control.h>

#include <optional>
#include <string>
#include <vector>

namespace gelatin {

/// While it lives, no more threads than these simulate; 0: all.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads) {
        if (threads > 0)
            limit_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    }

private:
    std::optional<tbb::global_control> limit_;
};

/// What the CPU backend is measured with: one thread, and all of the machine's where it has more.
std::vector<int> measured_thread_counts();

/// "CPU, 2 threads".
std::string describe_cpu(int threads);

}  // namespace gelatin
