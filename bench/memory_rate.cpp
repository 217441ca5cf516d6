#include "bench/memory_rate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <functional>
#include <vector>

#include "bench/threads.h"
#include "gl/buffer.h"
#include "gl/program.h"

namespace gelatin {
namespace {

constexpr std::size_t kCopied = std::size_t{128} << 20;  // [bytes], what every driver gives a storage block
constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr int kCopies = 8;

double best_rate(const std::function<void()>& copy) {
    copy();  // faults pages in
    double best = 0.0;
    for (int c = 0; c < kCopies; ++c) {
        const auto start = std::chrono::steady_clock::now();
        copy();
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        best = std::max(best, 2.0 * static_cast<double>(kCopied) / elapsed.count());
    }
    return best;
}

}  // namespace

double cpu_memory_rate(int threads) {
    const ThreadLimit limit(threads);
    const std::vector<std::byte> source(kCopied, std::byte{1});
    std::vector<std::byte> target(kCopied);
    return best_rate([&] {
        tbb::parallel_for(std::size_t{0}, kCopied / kPiece, [&](std::size_t piece) {
            std::memcpy(&target[piece * kPiece], &source[piece * kPiece], kPiece);
        });
    });
}

double device_memory_rate() {
    gl::Buffer<std::uint32_t> source(kCopied / sizeof(std::uint32_t)), target(source.size());
    source.fill(1);
    return best_rate([&] {
        target.copy_from(source);
        gl::finish();
    });
}

}  // namespace gelatin
