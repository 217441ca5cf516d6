#pragma once

#include <string_view>

namespace gelatin::gl {

/// What the work after the barrier will do with the data written before it (glMemoryBarrier).
enum class Barrier : unsigned {
    none = 0,
    storage = 1,        ///< read or write as a storage block
    texture_fetch = 2,  ///< texelFetch from a samplerBuffer
    vertex_pull = 4,    ///< element or vertex arrays
    buffer_update = 8,  ///< copies, clears, mapping, upload, download
    command = 16,       ///< indirect dispatch or draw
    pixel_unpack = 32,  ///< upload to a texture
};
constexpr Barrier operator|(Barrier a, Barrier b) {
    return static_cast<Barrier>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr Barrier operator&(Barrier a, Barrier b) {
    return static_cast<Barrier>(static_cast<unsigned>(a) & static_cast<unsigned>(b));
}
constexpr Barrier without(Barrier set, Barrier removed) {
    return static_cast<Barrier>(static_cast<unsigned>(set) & ~static_cast<unsigned>(removed));
}

/// A line of the sources. (std::source_location is newer than the compilers that Gelatin is built with.)
struct CallSite {
    std::string_view file;
    int line = 0;

    /// Where this is called; as a default argument, where the function that has it is called.
    static constexpr CallSite here(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
        return {file, line};
    }
    // NOLINTNEXTLINE(modernize-use-nullptr): a false alarm on comparisons with 0 that are made up
    friend constexpr auto operator<=>(const CallSite&, const CallSite&) = default;
};

/// Makes what shaders wrote before it visible to `next_use` after it. A function that wraps the call passes
/// its own caller on as `where`.
void barrier(Barrier next_use, CallSite where = CallSite::here());

}  // namespace gelatin::gl
