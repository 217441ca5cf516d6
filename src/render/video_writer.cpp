#include "render/video_writer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>

#include "gelatin/error.h"

namespace gelatin::render {
namespace {

namespace fs = std::filesystem;

int next_even(int n) {
    return n + n % 2;
}

void check_ending(const fs::path& file) {
    if (is_stream(file)) return;
    const std::string ending = file.extension().string();
    if (ending == ".mp4" || ending == ".mov" || ending == ".mkv") return;
    throw InvalidInput({file.string(), 0, {}, {}, "a film's name must end in .mp4, .mov or .mkv"});
}

std::vector<std::string> encoder_command(const fs::path& file, int width, int height, FrameRate rate) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    const std::string frames = std::to_string(rate.numerator) + "/" + std::to_string(rate.denominator);
    // -xerror, because otherwise ffmpeg reports success after a failed write at the film's end.
    return {"ffmpeg",
            "-nostdin",
            "-hide_banner",
            "-loglevel",
            "error",
            "-xerror",
            "-y",  //
            "-f",
            "rawvideo",
            "-pixel_format",
            "rgb24",
            "-video_size",
            size,
            "-framerate",
            frames,  //
            "-i",
            "-",
            "-an",
            "-vf",
            "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",  //
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "bt709",  //
            "-c:v",
            "libx264",
            "-preset",
            "fast",
            "-crf",
            "18",
            "-movflags",
            "+faststart",  //
            "file:" + file.string()};
}

std::string last_line(const std::string& text) {
    const std::size_t end = text.find_last_not_of(" \r\n");
    if (end == std::string::npos) return {};
    const std::size_t before = text.find_last_of("\r\n", end);
    const std::size_t start = before == std::string::npos ? 0 : before + 1;
    return text.substr(start, end - start + 1);
}

std::string describe(const ProcessResult& result) {
    const std::string words = last_line(result.output);
    if (!words.empty()) return "ffmpeg: " + words;
    if (result.signal != 0) return "ffmpeg was ended by signal " + std::to_string(result.signal);
    return "ffmpeg ended with exit code " + std::to_string(result.exit_code);
}

}  // namespace

FrameRate FrameRate::from(double rate) {
    if (!(rate >= 0.001 && rate <= 1e6)) {
        throw InvalidInput(
            {{}, 0, "frame rate", std::to_string(rate), "a film has 0.001 to 1,000,000 frames a second"});
    }
    const int thousandths = static_cast<int>(std::lround(rate * 1000.0));
    const int common = std::gcd(thousandths, 1000);
    return {thousandths / common, 1000 / common};
}

VideoWriter::VideoWriter(fs::path file, int width, int height, FrameRate rate)
    : file_(std::move(file)), width_(next_even(width)), height_(next_even(height)) {
    check_ending(file_);
    if (is_stream(file_)) folder_.emplace();
    partial_ = folder_ ? folder_->path() / "film.mp4" : partial_name(link_target(file_));
    try {
        encoder_ = std::make_unique<FedProcess>(encoder_command(partial_, width_, height_, rate));
    } catch (const SystemError& error) {
        throw SystemError(file_.string() + ": cannot be written: " + error.what() +
                          "; films need the program ffmpeg (Debian: apt install ffmpeg)");
    }
}

VideoWriter::~VideoWriter() {
    discard();
}

void VideoWriter::discard() {
    if (!encoder_) return;
    encoder_.reset();  // ends ffmpeg before its file is removed
    std::error_code ignored;
    fs::remove(partial_, ignored);
}

void VideoWriter::fail(const std::string& reason) {
    discard();
    throw SystemError(file_.string() + ": the film cannot be written: " + reason);
}

void VideoWriter::write(const Image& frame) {
    assert(next_even(frame.width) == width_ && next_even(frame.height) == height_);
    const std::uint8_t* pixels = frame.pixels.data();
    if (frame.width != width_ || frame.height != height_) {
        // 4:2:0 has one colour for 2 x 2 pixels: the last column and row are repeated.
        padded_.resize(3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
        std::uint8_t* to = padded_.data();
        for (int y = 0; y < height_; ++y) {
            const std::uint8_t* row = frame.at(0, std::min(y, frame.height - 1));
            to = std::copy_n(row, 3 * frame.width, to);
            if (frame.width != width_) to = std::copy_n(row + 3 * (frame.width - 1), 3, to);
        }
        pixels = padded_.data();
    }
    const std::size_t bytes = 3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    if (!encoder_->write(pixels, bytes)) fail(describe(encoder_->finish()));
    ++frames_;
}

void VideoWriter::finish() {
    if (frames_ == 0) {
        discard();
        throw InvalidInput({file_.string(), 0, {}, {}, "a film needs at least one frame"});
    }
    const ProcessResult result = encoder_->finish();
    // At this log level ffmpeg reports errors only.
    if (!result.succeeded() || !result.output.empty()) fail(describe(result));
    if (folder_) {
        write_file(file_, read_file(partial_));
    } else {
        std::error_code error;
        fs::rename(partial_, link_target(file_), error);
        if (error) fail(error.message());
    }
    encoder_.reset();
}

}  // namespace gelatin::render
