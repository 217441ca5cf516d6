#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "gl/fence.h"

namespace gelatin::gl {

/// Brings buffer contents to the host without stalling: a copy to a staging buffer and a fence now, the data
/// later. A small ring of staging buffers is reused.
class Readback {
public:
    Readback() = default;
    Readback(const Readback&) = delete;
    Readback& operator=(const Readback&) = delete;
    ~Readback();

    /// Starts a copy of the first `bytes` of GL buffer `source`, after all GL commands so far and with what
    /// their shaders wrote: no barrier is needed before.
    void begin(unsigned source, std::size_t bytes);

    /// True if the oldest copy can be taken without waiting.
    bool ready() const;
    std::size_t pending() const { return pending_.size(); }

    /// The oldest copy's bytes; waits for its fence if necessary. @pre pending() > 0
    std::vector<std::byte> take();

private:
    struct Copy {
        unsigned staging;
        std::size_t bytes;
        Fence fence;
    };
    struct Staging {
        unsigned id;
        std::size_t bytes;
    };
    std::deque<Copy> pending_;
    std::vector<Staging> free_;
};

}  // namespace gelatin::gl
