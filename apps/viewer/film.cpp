#include "film.h"

#include <utility>

namespace gelatin::viewer {
namespace {

constexpr int kRate = 60;            // pictures per second
constexpr double kLongestGap = 0.5;  // of simulated time; longer gaps were not watched [s]

}  // namespace

Film::Film(const std::filesystem::path& file, int width, int height)
    : file_(file),
      width_(width),
      height_(height),
      grabber_(width, height),
      writer_(file, width, height, {kRate, 1}) {}

void Film::add(unsigned framebuffer, double time, double speed) {
    const double interval = speed / kRate;
    if (!next_ || time < *next_ - 2.0 * interval || time > *next_ + kLongestGap) next_ = time;
    int pictures = 0;
    for (; *next_ <= time + 1e-9; *next_ += interval) ++pictures;
    if (pictures == 0) return;
    // The grabber returns the previous picture.
    const std::optional<render::Image> before = grabber_.grab(framebuffer);
    write(before);
    repeats_ = pictures;
}

void Film::write(const std::optional<render::Image>& picture) {
    if (!picture) return;
    for (int i = 0; i < repeats_; ++i) writer_.write(*picture);
    is_empty_ = is_empty_ && repeats_ == 0;
}

void Film::finish() {
    write(grabber_.flush());
    if (!is_empty_) writer_.finish();
}

}  // namespace gelatin::viewer
