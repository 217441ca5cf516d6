#pragma once

#include <utility>

namespace gelatin::gl {

/// A mark among the commands to the GPU that can be queried or waited for. Move-only; a moved-from fence
/// counts as passed.
class Fence {
public:
    Fence() = default;

    /// Marks the end of all GL commands so far.
    static Fence insert();

    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        Fence taken(std::move(other));
        std::swap(sync_, taken.sync_);
        return *this;
    }
    ~Fence();

    /// True once the GPU has completed everything before the mark.
    bool is_passed() const;

    /// Waits for that. @throws GlError if the context is lost.
    void wait() const;

private:
    void* sync_ = nullptr;  // GLsync
};

}  // namespace gelatin::gl
