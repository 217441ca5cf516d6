#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct XXH3_state_s;

namespace gelatin {

/// A 128-bit hash (XXH3) of everything that was added, in order: an identifier of the content.
class ContentHash {
public:
    ContentHash();

    void add(const void* data, std::size_t bytes);
    /// The text and its length, so that different lists of texts never have the same bytes.
    void add(const std::string& text);
    /// The values and their number. @pre T has no padding
    template <class T>
    void add(const std::vector<T>& values) {
        const std::uint64_t count = values.size();
        add(&count, sizeof(count));
        add(values.data(), values.size() * sizeof(T));
    }

    std::uint64_t low() const;
    std::uint64_t high() const;
    std::string hex() const;  ///< 32 digits

private:
    struct Free {
        void operator()(XXH3_state_s* state) const;
    };
    std::unique_ptr<XXH3_state_s, Free> state_;
};

}  // namespace gelatin
