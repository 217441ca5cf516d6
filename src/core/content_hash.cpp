#include "core/content_hash.h"

#include <fmt/core.h>
#include <xxhash.h>

namespace gelatin {

ContentHash::ContentHash() : state_(XXH3_createState()) {
    XXH3_128bits_reset(state_.get());
}

void ContentHash::add(const void* data, std::size_t bytes) {
    if (bytes > 0) XXH3_128bits_update(state_.get(), data, bytes);
}

void ContentHash::add(const std::string& text) {
    const std::uint64_t length = text.size();
    add(&length, sizeof(length));
    add(text.data(), text.size());
}

std::uint64_t ContentHash::low() const {
    return XXH3_128bits_digest(state_.get()).low64;
}

std::uint64_t ContentHash::high() const {
    return XXH3_128bits_digest(state_.get()).high64;
}

std::string ContentHash::hex() const {
    return fmt::format("{:016x}{:016x}", high(), low());
}

void ContentHash::Free::operator()(XXH3_state_s* state) const {
    XXH3_freeState(state);
}

}  // namespace gelatin
