#include "common/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gelatin {
namespace {

constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kRedraw{100};

// How much of the frames from `first` to `total` is done, from 0 to 1.
double part(int first, int done, int total) {
    return total > first ? static_cast<double>(done - first) / (total - first) : 1.0;
}

}  // namespace

std::string describe_duration(double seconds) {
    const auto whole = static_cast<long long>(std::llround(std::min(std::max(seconds, 0.0), 1e9)));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

Progress::Progress(int first, int total, bool quiet)
    : first_(first),
      total_(total),
      quiet_(quiet),
      is_terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()) {}

Progress::~Progress() {
    if (has_bar_) std::fputc('\n', stderr);
}

std::string Progress::describe(int done, Clock::time_point now) const {
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double rate = seconds > 0.0 ? (done - first_) / seconds : 0.0;
    std::string text = fmt::format("{:3.0f}%  frame {} of {}, {:.1f} frames/s",
                                   std::floor(100.0 * part(first_, done, total_)), done, total_, rate);
    if (done < total_ && rate > 0.0) text += ", " + describe_duration((total_ - done) / rate) + " left";
    return text;
}

void Progress::update(int done) {
    if (quiet_) return;
    const Clock::time_point now = Clock::now();
    if (is_terminal_) {
        if (done == total_ || now - last_drawn_ >= kRedraw) draw_bar(done, now);
        return;
    }
    const int tenths = static_cast<int>(std::floor(10.0 * part(first_, done, total_)));
    if (tenths <= tenths_told_) return;
    tenths_told_ = tenths;
    std::fprintf(stderr, "gelatin: %s\n", describe(done, now).c_str());
}

void Progress::draw_bar(int done, Clock::time_point now) {
    constexpr const char* kClearToEnd = "\033[K";
    const auto filled = static_cast<std::size_t>(std::floor(kBarWidth * part(first_, done, total_)));
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    std::fprintf(stderr, "\r[%s] %s%s", bar.c_str(), describe(done, now).c_str(), kClearToEnd);
    std::fflush(stderr);
    has_bar_ = true;
    last_drawn_ = now;
}

}  // namespace gelatin
