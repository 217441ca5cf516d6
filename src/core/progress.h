#pragma once

#include <string_view>

namespace gelatin {

/// Follows what a thread does that takes long, and may end it.
class ProgressListener {
public:
    virtual ~ProgressListener() = default;
    /// @param share done so far, from 0 to 1 @param what is done next
    virtual void on_progress(double share, std::string_view what) = 0;
    virtual bool is_cancelled() const = 0;
};

/// Makes `listener` the one of this thread while it lives.
class ListenToProgress {
public:
    explicit ListenToProgress(ProgressListener& listener);
    ListenToProgress(const ListenToProgress&) = delete;
    ListenToProgress& operator=(const ListenToProgress&) = delete;
    ~ListenToProgress();

private:
    ProgressListener* outer_;
};

/// Calls this thread's listener, if it has one. @throws Cancelled as check_cancelled
void report_progress(double share, std::string_view what);

/// @throws Cancelled if this thread has a listener that has cancelled what it does. Cheap; for loops that
/// take long.
void check_cancelled();

}  // namespace gelatin
