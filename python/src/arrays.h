#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace gelatin::python {

namespace nb = nanobind;

/// Arrays that nobody may write into.
using Vectors = nb::ndarray<nb::numpy, const float, nb::shape<-1, 3>>;
using Indices = nb::ndarray<nb::numpy, const std::uint32_t, nb::ndim<2>>;

/// What keeps the memory of a view alive.
using Owner = std::shared_ptr<const void>;
nb::capsule capsule_of(Owner owner);

/// The xyz of four-component vectors, without a copy.
Vectors view_of(std::span<const glm::vec4> values, Owner owner);

/// The first `columns` of rows of four indices, without a copy.
Indices view_of(const std::uint32_t* rows, std::size_t count, std::size_t columns, Owner owner);

/// An array of its own. @param values x, y, z of each, shape [n][3]
Vectors array_of(std::vector<float> values);

}  // namespace gelatin::python
