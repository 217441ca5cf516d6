#include "worker.h"

#include <utility>

namespace gelatin::viewer {

Worker::Worker() : thread_([this] { run(); }) {}

Worker::~Worker() {
    {
        const std::lock_guard lock(mutex_);
        is_ending_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void Worker::start(std::function<void()> job) {
    {
        const std::lock_guard lock(mutex_);
        job_ = std::move(job);
    }
    changed_.notify_one();
}

bool Worker::is_busy() const {
    const std::lock_guard lock(mutex_);
    return job_ != nullptr;
}

void Worker::rethrow() {
    const std::lock_guard lock(mutex_);
    if (problem_) std::rethrow_exception(std::exchange(problem_, nullptr));
}

void Worker::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return is_ending_ || job_; });
        if (!job_) return;
        lock.unlock();
        std::exception_ptr problem;
        try {
            job_();
        } catch (...) {
            problem = std::current_exception();
        }
        lock.lock();
        problem_ = std::move(problem);
        job_ = nullptr;
    }
}

}  // namespace gelatin::viewer
