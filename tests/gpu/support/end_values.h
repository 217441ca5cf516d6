#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/archive.h"
#include "gl/barrier.h"
#include "gl/buffer.h"
#include "gpu/support/scenario.h"

namespace gelatin::test {

/// The greatest error over its bound.
class WorstError {
public:
    void add(double actual, double expected, double bound) {
        const double error = std::abs(actual - expected) / bound;
        worst_ = std::isfinite(error) ? std::max(worst_, error) : std::numeric_limits<double>::infinity();
    }
    void add(const glm::dvec3& actual, const glm::dvec3& expected, double bound) {
        for (int k = 0; k < 3; ++k) add(actual[k], expected[k], bound);
    }
    void fail_if(bool is_wrong) { worst_ = std::max(worst_, error_if(is_wrong)); }
    double worst() const { return worst_; }

private:
    double worst_ = 0.0;
};

/// The private state of one of the reference's classes, in the order in which it is written.
class StateReader {
public:
    template <class Owner>
    explicit StateReader(Owner& owner) {
        Archive archive = Archive::that_writes(bytes_);
        owner.archive(archive);
    }
    template <class T>
    T take() {
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    template <class T>
    std::vector<T> take(std::size_t count) {
        std::vector<T> values;
        for (std::size_t k = 0; k < count; ++k) values.push_back(take<T>());
        return values;
    }

private:
    std::string bytes_;
    std::size_t at_ = 0;
};

/// Waits for it.
template <class T>
std::vector<T> read(const gl::Buffer<T>& buffer) {
    std::vector<T> values(buffer.size());
    gl::barrier(gl::Barrier::buffer_update);
    buffer.download(values);
    return values;
}

}  // namespace gelatin::test
