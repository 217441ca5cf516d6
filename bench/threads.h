#pragma once

#include <tbb/global_control.h>

#include <optional>
#include <string>
#include <vector>

namespace gelatin {

/// During its lifetime, at most this many threads simulate; 0: all.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads) {
        if (threads > 0)
            limit_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    }

private:
    std::optional<tbb::global_control> limit_;
};

/// The thread counts with which the CPU backend is measured: one, and all of the machine's if it has more.
std::vector<int> measured_thread_counts();

/// "CPU, 2 threads".
std::string describe_cpu(int threads);

}  // namespace gelatin
