#include "sim/animation/point_cache.h"

#include <bit>
#include <cstdint>
#include <utility>

#include "core/file_writer.h"
#include "sim/animation/animated_surface.h"

namespace gelatin {
namespace {

template <class T>
void append_little(T value, std::string& bytes) {
    static_assert(std::endian::native == std::endian::little && sizeof(T) == 4);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

template <class T>
void append_big(T value, std::string& bytes) {
    const auto number = std::bit_cast<std::uint32_t>(value);
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
}

}  // namespace

PointCacheFile::PointCacheFile(std::filesystem::path file, Kind kind, const Model& model, double frame_rate)
    : file_(std::move(file)),
      kind_(kind),
      frame_rate_(frame_rate),
      points_(make_animated_surface(model).points),
      points_of_frames_(file_, 3 * points_.size()) {}

void PointCacheFile::write(const HostFrame& frame) {
    frames_.push_back(frame.frame);
    times_.push_back(frame.time);
    points_of_frames_.add(carry_skin(points_, std::span(frame.positions)));
}

std::string PointCacheFile::bytes_of(const std::vector<float>& values) const {
    std::string bytes;
    for (const float value : values) {
        if (kind_ == Kind::pc2) append_little(value, bytes);
        if (kind_ == Kind::mdd) append_big(value, bytes);
    }
    return bytes;
}

// PC2 counts time in frames, MDD in seconds.
std::string PointCacheFile::head() const {
    const auto samples = static_cast<std::int32_t>(frames_.size()),
               points = static_cast<std::int32_t>(points_.size());
    std::string bytes;
    if (kind_ == Kind::mdd) {
        append_big(samples, bytes);
        append_big(points, bytes);
        for (const double time : times_) append_big(static_cast<float>(time), bytes);
        return bytes;
    }
    const int spacing = frames_.size() > 1 ? frames_[1] - frames_[0] : 1;
    bytes.append("POINTCACHE2\0", 12);
    append_little(std::int32_t(1), bytes);
    append_little(points, bytes);
    append_little(static_cast<float>(frames_.empty() ? 0 : frames_[0]), bytes);
    append_little(static_cast<float>(spacing), bytes);
    append_little(samples, bytes);
    return bytes;
}

void PointCacheFile::finish() {
    FileWriter out(file_);
    out.append(head());
    for (std::size_t f = 0; f < frames_.size(); ++f)
        out.append(bytes_of(points_of_frames_.read(f, 0, 3 * points_.size())));
    out.finish();
}

}  // namespace gelatin
