#pragma once

#include <span>
#include <vector>

#include "gl/buffer.h"

namespace gelatin::gpu {

/// Holds `values`, or `padding` where there are none: a buffer texture needs an element.
template <class T>
gl::Buffer<T> make_buffer(std::vector<T> values, const T& padding = {}) {
    if (values.empty()) values.push_back(padding);
    return gl::Buffer<T>(std::span<const T>(values));
}

}  // namespace gelatin::gpu
