#pragma once

#include <cstddef>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace gelatin {

/// Values as bytes, one after the other: appended to a string, or read back in the same order, by one
/// function of what has them.
class Archive {
public:
    /// @param bytes output, which has to live as long as the archive
    static Archive that_writes(std::string& bytes) { return {&bytes, {}}; }
    static Archive that_reads(std::string_view bytes) { return {nullptr, bytes}; }

    template <class T>
    void value(T& value) {
        pass(&value, 1);
    }
    /// As many values as the array has already.
    template <class T>
    void array(std::vector<T>& values) {
        pass(values.data(), values.size());
    }
    /// Any number of values.
    template <class T>
    void list(std::vector<T>& values) {
        std::size_t count = values.size();
        value(count);
        if (writes_ == nullptr && count > left_.size() / sizeof(T)) return fail();
        values.resize(count);
        array(values);
    }
    template <class First, class Second, class T>
    void map(std::map<std::pair<First, Second>, T>& values) {
        const auto written = std::exchange(values, {});
        auto next = written.begin();
        std::size_t count = written.size();
        value(count);
        for (std::size_t k = 0; k < count && !has_failed_; ++k) {
            std::pair<First, Second> key;
            T item;
            if (writes_ != nullptr) std::tie(key, item) = *next++;
            value(key.first);
            value(key.second);
            value(item);
            values.emplace(key, item);
        }
    }

    /// Whether all that was read was there, and nothing is left.
    bool is_complete() const { return !has_failed_ && left_.empty(); }
    void fail() { has_failed_ = true; }

private:
    Archive(std::string* writes, std::string_view left) : writes_(writes), left_(left) {}

    template <class T>
    void pass(T* values, std::size_t count) {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::size_t size = count * sizeof(T);
        if (size == 0) return;
        if (writes_ != nullptr) {
            writes_->append(reinterpret_cast<const char*>(values), size);
        } else if (has_failed_ || size > left_.size()) {
            fail();
        } else {
            std::memcpy(static_cast<void*>(values), left_.data(), size);
            left_.remove_prefix(size);
        }
    }

    std::string* writes_;
    std::string_view left_;
    bool has_failed_ = false;
};

}  // namespace gelatin
