#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace gelatin::viewer {

/// A thread that does one job at a time in the background. Use it from one thread.
class Worker {
public:
    Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    /// Waits for the running job.
    ~Worker();

    /// @pre !is_busy()
    void start(std::function<void()> job);
    bool is_busy() const;

    /// @pre !is_busy(). @throws the last job's exception, once.
    void rethrow();

private:
    void run();

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::function<void()> job_;  // empty: no job
    std::exception_ptr problem_;
    bool is_ending_ = false;
    std::thread thread_;  // last: it uses the others
};

}  // namespace gelatin::viewer
