#pragma once

#include <array>
#include <cstddef>

namespace gelatin::viewer {

/// The latest values of one quantity, for a graph: a ring buffer whose oldest value is at `start()`.
class History {
public:
    static constexpr std::size_t kLength = 240;

    void add(float value) {
        values_[next_ % kLength] = value;
        ++next_;
    }
    void clear() { next_ = 0; }

    const float* data() const { return values_.data(); }
    int size() const { return static_cast<int>(next_ < kLength ? next_ : kLength); }
    int start() const { return static_cast<int>(next_ < kLength ? 0 : next_ % kLength); }
    float latest() const { return next_ == 0 ? 0.0f : values_[(next_ - 1) % kLength]; }

private:
    std::array<float, kLength> values_{};
    std::size_t next_ = 0;
};

}  // namespace gelatin::viewer
