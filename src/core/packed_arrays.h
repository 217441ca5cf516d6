#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace gelatin {

/// Appends arrays to bytes, each preceded by its number of elements, in this machine's representation.
class ArrayWriter {
public:
    template <class T>
    void add(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::uint64_t count = values.size();
        append(&count, sizeof(count));
        append(values.data(), values.size() * sizeof(T));
    }
    const std::string& bytes() const { return bytes_; }

private:
    void append(const void* data, std::size_t size) {
        if (size > 0) bytes_.append(static_cast<const char*>(data), size);
    }
    std::string bytes_;
};

/// Extracts arrays from bytes, in the order in which they were added.
class ArrayReader {
public:
    explicit ArrayReader(const std::string& bytes) : bytes_(bytes) {}

    /// False if there are not as many bytes as the array should have.
    template <class T>
    bool take(std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        std::uint64_t count = 0;
        if (!copy(&count, sizeof(count)) || count > (bytes_.size() - at_) / sizeof(T)) return false;
        values.resize(count);
        return copy(values.data(), count * sizeof(T));
    }
    bool at_end() const { return at_ == bytes_.size(); }

private:
    bool copy(void* to, std::size_t size) {
        if (size > bytes_.size() - at_) return false;
        if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
        at_ += size;
        return true;
    }
    const std::string& bytes_;
    std::size_t at_ = 0;
};

}  // namespace gelatin
