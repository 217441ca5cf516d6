#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "cpu/nodes.h"

/// What formulas call by one name for any scalar; for lanes of floats see cpu/float_lanes-inl.h.
namespace gelatin::cpu {

template <class Real>
using Mat3 = glm::mat<3, 3, Real>;

template <class Real>
constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();

/// a b + c
template <class T>
T multiply_add(const T& a, const T& b, const T& c) {
    return a * b + c;
}
template <class Real>
Vec3<Real> multiply_add(Real factor, const Vec3<Real>& a, const Vec3<Real>& b) {
    return factor * a + b;
}

template <class Real>
Real select(bool condition, Real a, Real b) {
    return condition ? a : b;
}

template <class Real>
Real larger(Real a, Real b) {
    return std::max(a, b);
}

template <class Real>
Real square_root(Real value) {
    return std::sqrt(value);
}

/// The natural one.
template <class Real>
Real logarithm(Real value) {
    return std::log(value);
}

}  // namespace gelatin::cpu
