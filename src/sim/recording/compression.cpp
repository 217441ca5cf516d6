#include "sim/recording/compression.h"

#include <zstd.h>

#include <memory>

#include "gelatin/error.h"

namespace gelatin {
namespace {

constexpr int kWindowLog = 27;  // the largest that zstd decompresses without being asked to

}  // namespace

std::string compressed(const std::string& bytes, int level, bool has_far_copies) {
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
    if (has_far_copies) {
        ZSTD_CCtx_setParameter(context.get(), ZSTD_c_enableLongDistanceMatching, 1);
        ZSTD_CCtx_setParameter(context.get(), ZSTD_c_windowLog, kWindowLog);
    }
    std::string result(ZSTD_compressBound(bytes.size()), '\0');
    const std::size_t size =
        ZSTD_compress2(context.get(), result.data(), result.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size) != 0) throw Error(std::string("zstd: ") + ZSTD_getErrorName(size));
    result.resize(size);
    return result;
}

std::string decompressed(std::string_view bytes, std::size_t most) {
    const auto refuse = [] { throw InvalidInput({{}, 0, {}, {}, "is damaged"}); };
    const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (size > most) refuse();  // or it is unknown: these values are the largest
    std::string result(size, '\0');
    if (ZSTD_decompress(result.data(), result.size(), bytes.data(), bytes.size()) != size) refuse();
    return result;
}

}  // namespace gelatin
