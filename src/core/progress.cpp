#include "core/progress.h"

#include <utility>

#include "gelatin/error.h"

namespace gelatin {
namespace {

thread_local ProgressListener* current = nullptr;

}  // namespace

ListenToProgress::ListenToProgress(ProgressListener& listener) : outer_(std::exchange(current, &listener)) {}

ListenToProgress::~ListenToProgress() {
    current = outer_;
}

void report_progress(double share, std::string_view what) {
    check_cancelled();
    if (current != nullptr) current->on_progress(share, what);
}

void check_cancelled() {
    if (current != nullptr && current->is_cancelled()) throw Cancelled("cancelled");
}

}  // namespace gelatin
